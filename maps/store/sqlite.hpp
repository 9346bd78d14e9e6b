// Owners of SQLite's handles, for the map store only. Every failure is a StoreError that says what
// SQLite said; callers add the file and the table.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "maps/store/map_store.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace cairn::store {

class Database {
 public:
  [[nodiscard]] static Database in_memory();
  [[nodiscard]] static Database read_only(const std::filesystem::path& file);
  // In memory, with the bytes that a file would have.
  [[nodiscard]] static Database of_bytes(const std::string& bytes);

  void execute(const std::string& sql);
  // The bytes that the database would have as a file.
  [[nodiscard]] std::string serialized() const;
  // Since it was opened, to files: also to those that were attached and still are.
  [[nodiscard]] std::int64_t pages_written() const;

 private:
  friend class Statement;
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  Database(const std::string& name, int flags);
  [[noreturn]] void fail() const;

  std::unique_ptr<sqlite3, Close> handle_;
};

// One prepared statement: bind its parameters from left to right, step through its rows.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);

  Statement& bind(std::integral auto value) { return bind_integer(static_cast<std::int64_t>(value)); }
  Statement& bind(double value);  // what is not finite becomes NULL, which no table accepts where it matters
  Statement& bind(const std::optional<double>& value);
  Statement& bind(const Pose2& pose);  // three columns
  Statement& bind(const std::optional<Pose2>& pose);
  Statement& bind_text(const std::string& value);
  Statement& bind_blob(const std::string& value);
  Statement& bind_row(const Statement& row);  // all columns of its current row
  void run();                                 // a statement without rows; ready for the next bindings afterwards
  bool step();                                // to the next row; false behind the last

  // Of the current row. A value of another type throws StoreError with the column's name.
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] std::int64_t integer_within(int column, std::int64_t least, std::int64_t greatest) const;
  [[nodiscard]] double real(int column) const;  // always finite
  [[nodiscard]] std::optional<double> optional_real(int column) const;
  [[nodiscard]] Pose2 pose(int first_column) const;
  [[nodiscard]] std::optional<Pose2> optional_pose(int first_column) const;
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::string plain_text(int column) const;  // without control characters but those of lines
  [[nodiscard]] std::string blob(int column) const;
  [[nodiscard]] int columns() const;
  [[nodiscard]] std::string first_text() const;  // the first column as people read it, whatever its type, in one line
  // Canonical bytes of the row but for the content of blobs, which carry checksums of their own.
  [[nodiscard]] std::string row_bytes() const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const;
  };
  Statement& bind_integer(std::int64_t value);
  void require_type(int column, int type, const char* name) const;
  [[noreturn]] void fail_at(int column, const std::string& what) const;

  Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
  int bound_ = 0;
};

}  // namespace cairn::store
