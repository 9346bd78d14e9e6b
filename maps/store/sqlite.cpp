#include "maps/store/sqlite.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cmath>

#include "maps/base/printable.hpp"
#include "maps/store/tables/codec.hpp"

namespace cairn::store {
namespace {

constexpr int kMaxValueBytes = 256 << 20;
constexpr int kBusyFor_ms = 3000;  // another may be reading the autosave before, which becomes the next one

const char* name_of(int type) {
  switch (type) {
    case SQLITE_INTEGER:
      return "an integer";
    case SQLITE_FLOAT:
      return "a number";
    case SQLITE_TEXT:
      return "a text";
    case SQLITE_BLOB:
      return "a blob";
    default:
      return "nothing";
  }
}

}  // namespace

void Database::Close::operator()(sqlite3* handle) const {
  sqlite3_close_v2(handle);
}

Database::Database(const std::string& name, int flags) {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (handle == nullptr) throw StoreError("SQLite is out of memory");
  if (code != SQLITE_OK) fail();
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kMaxValueBytes);
  sqlite3_busy_timeout(handle, kBusyFor_ms);
  // The file may come from anywhere: nothing in its schema may call functions with side effects.
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
}

Database Database::in_memory() {
  return {":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX};
}

Database Database::read_only(const std::filesystem::path& file) {
  // Absolute, so that no file name reads as ":memory:" or as a URI.
  return {std::filesystem::absolute(file).string(), SQLITE_OPEN_READONLY};
}

Database Database::of_bytes(const std::string& bytes) {
  Database database = in_memory();
  const auto size = static_cast<sqlite3_int64>(bytes.size());
  auto* copy = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size() + 1));
  if (copy == nullptr) throw StoreError("SQLite is out of memory");
  std::ranges::copy(bytes, copy);
  constexpr unsigned kFlags = SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE;
  if (sqlite3_deserialize(database.handle_.get(), "main", copy, size, size, kFlags) != SQLITE_OK) database.fail();
  return database;
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::string Database::serialized() const {
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> bytes(sqlite3_serialize(handle_.get(), "main", &size, 0),
                                                              sqlite3_free);
  if (bytes == nullptr) throw StoreError("SQLite has no memory for it; a map's file can have 2 GB at most");
  return {reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size)};
}

std::int64_t Database::pages_written() const {
  int pages = 0;
  int highest = 0;
  sqlite3_db_status(handle_.get(), SQLITE_DBSTATUS_CACHE_WRITE, &pages, &highest, 0);
  return pages;
}

void Database::fail() const {
  throw StoreError(sqlite3_errmsg(handle_.get()));
}

void Statement::Finalize::operator()(sqlite3_stmt* handle) const {
  sqlite3_finalize(handle);
}

Statement::Statement(Database& database, const std::string& sql) : database_(&database) {
  sqlite3_stmt* handle = nullptr;
  const int code = sqlite3_prepare_v2(database.handle_.get(), sql.c_str(), -1, &handle, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) database.fail();
}

Statement& Statement::bind_integer(std::int64_t value) {
  if (sqlite3_bind_int64(handle_.get(), ++bound_, value) != SQLITE_OK) database_->fail();
  return *this;
}

Statement& Statement::bind(double value) {
  const int code = std::isfinite(value) ? sqlite3_bind_double(handle_.get(), ++bound_, value)
                                        : sqlite3_bind_null(handle_.get(), ++bound_);
  if (code != SQLITE_OK) database_->fail();
  return *this;
}

Statement& Statement::bind(const std::optional<double>& value) {
  if (value && !std::isfinite(*value)) throw StoreError("an optional number is not finite");
  if (value) return bind(*value);
  if (sqlite3_bind_null(handle_.get(), ++bound_) != SQLITE_OK) database_->fail();
  return *this;
}

Statement& Statement::bind(const Pose2& pose) {
  return bind(pose.x_m).bind(pose.y_m).bind(pose.theta_rad);
}

Statement& Statement::bind(const std::optional<Pose2>& pose) {
  for (double Pose2::*part : {&Pose2::x_m, &Pose2::y_m, &Pose2::theta_rad})
    bind(pose ? std::optional((*pose).*part) : std::nullopt);
  return *this;
}

Statement& Statement::bind_text(const std::string& value) {
  if (sqlite3_bind_text64(handle_.get(), ++bound_, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8) !=
      SQLITE_OK)
    database_->fail();
  return *this;
}

Statement& Statement::bind_blob(const std::string& value) {
  if (sqlite3_bind_blob64(handle_.get(), ++bound_, value.data(), value.size(), SQLITE_TRANSIENT) != SQLITE_OK)
    database_->fail();
  return *this;
}

Statement& Statement::bind_row(const Statement& row) {
  for (int column = 0; column < row.columns(); ++column)
    if (sqlite3_bind_value(handle_.get(), ++bound_, sqlite3_column_value(row.handle_.get(), column)) != SQLITE_OK)
      database_->fail();
  return *this;
}

void Statement::run() {
  if (sqlite3_step(handle_.get()) != SQLITE_DONE) database_->fail();
  sqlite3_reset(handle_.get());
  bound_ = 0;
}

bool Statement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_->fail();
  return code == SQLITE_ROW;
}

void Statement::fail_at(int column, const std::string& what) const {
  const char* const name = sqlite3_column_name(handle_.get(), column);
  throw StoreError("column " + std::string(name == nullptr ? "?" : name) + " " + what);
}

void Statement::require_type(int column, int type, const char* name) const {
  const int found = sqlite3_column_type(handle_.get(), column);
  if (found != type) fail_at(column, "holds " + std::string(name_of(found)) + " where " + name + " belongs");
}

std::int64_t Statement::integer(int column) const {
  require_type(column, SQLITE_INTEGER, "an integer");
  return sqlite3_column_int64(handle_.get(), column);
}

std::int64_t Statement::integer_within(int column, std::int64_t least, std::int64_t greatest) const {
  const std::int64_t value = integer(column);
  if (value < least || value > greatest)
    fail_at(column, "holds " + std::to_string(value) + ", allowed is " + std::to_string(least) + " to " +
                        std::to_string(greatest));
  return value;
}

double Statement::real(int column) const {
  require_type(column, SQLITE_FLOAT, "a number");
  const double value = sqlite3_column_double(handle_.get(), column);
  if (!std::isfinite(value)) fail_at(column, "is not finite");
  return value;
}

std::optional<double> Statement::optional_real(int column) const {
  if (sqlite3_column_type(handle_.get(), column) == SQLITE_NULL) return std::nullopt;
  return real(column);
}

Pose2 Statement::pose(int first_column) const {
  return {real(first_column), real(first_column + 1), real(first_column + 2)};
}

std::optional<Pose2> Statement::optional_pose(int first_column) const {
  for (int column = first_column; column < first_column + 3; ++column)
    if (optional_real(column)) return pose(first_column);
  return std::nullopt;
}

std::string Statement::text(int column) const {
  require_type(column, SQLITE_TEXT, "a text");
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))};
}

std::string Statement::plain_text(int column) const {
  std::string value = text(column);
  const std::size_t found = first_unprintable(value, kLineCharacters);
  if (found != std::string::npos) fail_at(column, "holds " + name_of_unprintable(value, found));
  return value;
}

std::string Statement::blob(int column) const {
  require_type(column, SQLITE_BLOB, "a blob");
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(handle_.get(), column));
  if (bytes == nullptr) return {};
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))};
}

int Statement::columns() const {
  return sqlite3_column_count(handle_.get());
}

std::string Statement::first_text() const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), 0));
  return bytes == nullptr ? "?" : printable(bytes);
}

std::string Statement::row_bytes() const {
  std::string bytes;
  for (int column = 0; column < sqlite3_column_count(handle_.get()); ++column) {
    const int type = sqlite3_column_type(handle_.get(), column);
    bytes.push_back(static_cast<char>(type));
    if (type == SQLITE_INTEGER) append_little_endian(bytes, sqlite3_column_int64(handle_.get(), column));
    if (type == SQLITE_FLOAT) append_little_endian(bytes, sqlite3_column_double(handle_.get(), column));
    if (type == SQLITE_TEXT) {
      const std::string value = text(column);
      append_little_endian(bytes, static_cast<std::int64_t>(value.size()));
      bytes += value;
    }
  }
  return bytes;
}

}  // namespace cairn::store
