#include "tests/fuzz/map_file.hpp"

#include <bit>
#include <cstring>

namespace cairn::fuzz {
namespace {

void append_little_endian(std::string& bytes, std::uint64_t bits) {
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<char>(bits >> (8 * i) & 0xFFU));
}

// What a row adds to its table's checksum; blobs have checksums of their own.
std::string summed_bytes(sqlite3_stmt* row) {
  std::string bytes;
  for (int column = 0; column < sqlite3_column_count(row); ++column) {
    const int type = sqlite3_column_type(row, column);
    bytes.push_back(static_cast<char>(type));
    if (type == SQLITE_INTEGER)
      append_little_endian(bytes, static_cast<std::uint64_t>(sqlite3_column_int64(row, column)));
    if (type == SQLITE_FLOAT)
      append_little_endian(bytes, std::bit_cast<std::uint64_t>(sqlite3_column_double(row, column)));
    if (type != SQLITE_TEXT) continue;
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
    const int size = sqlite3_column_bytes(row, column);
    append_little_endian(bytes, static_cast<std::uint64_t>(size));
    if (text != nullptr) bytes.append(text, static_cast<std::size_t>(size));
  }
  return bytes;
}

std::uint32_t crc32_of(const std::string& bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      crc32(before, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

}  // namespace

MapFile::MapFile(Input bytes) {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(":memory:", &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  std::unique_ptr<sqlite3, Close> database(handle);
  if (code != SQLITE_OK || bytes.empty()) return;
  auto* copy = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size()));
  std::memcpy(copy, bytes.data(), bytes.size());
  if (sqlite3_deserialize(handle, "main", copy, static_cast<sqlite3_int64>(bytes.size()),
                          static_cast<sqlite3_int64>(bytes.size()),
                          SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE) != SQLITE_OK)
    return;
  if (sqlite3_exec(handle, "SELECT count(*) FROM sqlite_schema", nullptr, nullptr, nullptr) != SQLITE_OK) return;
  database_ = std::move(database);
}

MapFile::Statement MapFile::prepared(const std::string& sql) {
  sqlite3_stmt* handle = nullptr;
  sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &handle, nullptr);
  return Statement(handle);
}

bool MapFile::execute(const std::string& sql) {
  return sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
}

std::vector<std::string> MapFile::column(const std::string& sql) {
  std::vector<std::string> texts;
  const Statement row = prepared(sql);
  while (row != nullptr && sqlite3_step(row.get()) == SQLITE_ROW) {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row.get(), 0));
    texts.emplace_back(text == nullptr ? "" : text);
  }
  return texts;
}

std::string MapFile::blob(const std::string& sql) {
  const Statement row = prepared(sql);
  if (row == nullptr || sqlite3_step(row.get()) != SQLITE_ROW) return {};
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(row.get(), 0));
  return bytes == nullptr ? "" : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(row.get(), 0)));
}

bool MapFile::execute_with_blob(const std::string& sql, const std::string& bytes) {
  const Statement statement = prepared(sql);
  if (statement == nullptr) return false;
  sqlite3_bind_blob64(statement.get(), 1, bytes.data(), bytes.size(), SQLITE_TRANSIENT);
  return sqlite3_step(statement.get()) == SQLITE_DONE;
}

void MapFile::sum_up(const std::string& table) {
  std::string order;
  for (const std::string& key : column("SELECT name FROM pragma_table_info('" + table + "') WHERE pk > 0 ORDER BY pk"))
    order += (order.empty() ? " ORDER BY " : ", ") + key;
  const Statement row = prepared("SELECT * FROM \"" + table + "\"" + order);
  std::uint32_t sum = 0;
  std::int64_t rows = 0;
  for (; row != nullptr && sqlite3_step(row.get()) == SQLITE_ROW; ++rows) sum = crc32_of(summed_bytes(row.get()), sum);
  execute("UPDATE checksums SET row_count = " + std::to_string(rows) + ", crc32 = " + std::to_string(sum) +
          " WHERE table_name = '" + table + "'");
}

void MapFile::sum_up() {
  for (const std::string& table : column("SELECT name FROM sqlite_schema WHERE type = 'table'")) sum_up(table);
}

std::string MapFile::bytes() {
  sqlite3_int64 size = 0;
  unsigned char* const copy = sqlite3_serialize(database_.get(), "main", &size, 0);
  std::string bytes;
  if (copy != nullptr) bytes.assign(reinterpret_cast<const char*>(copy), static_cast<std::size_t>(size));
  sqlite3_free(copy);
  return bytes;
}

std::string packed(const std::string& raw) {
  uLongf size = compressBound(raw.size());
  std::string bytes(size, '\0');
  compress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(raw.data()), raw.size());
  bytes.resize(size);
  return bytes;
}

std::string unpacked(const std::string& packed_bytes) {
  constexpr std::size_t kMax = 1 << 16;
  std::string raw(kMax, '\0');
  uLongf size = kMax;
  if (uncompress(reinterpret_cast<Bytef*>(raw.data()), &size, reinterpret_cast<const Bytef*>(packed_bytes.data()),
                 packed_bytes.size()) != Z_OK)
    return {};
  raw.resize(size);
  return raw;
}

}  // namespace cairn::fuzz
