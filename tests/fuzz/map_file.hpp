// A saved map's bytes as a database that can be written to, with the checksums made anew: a second, small
// implementation of the format, so that what is changed in a file is looked at by the reader and not by its checksums.
#pragma once

#include <sqlite3.h>
#include <zlib.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/fuzz/reader.hpp"

namespace cairn::fuzz {

class MapFile {
 public:
  // is_open() is false when the bytes are no database.
  explicit MapFile(Input bytes);

  [[nodiscard]] bool is_open() const { return database_ != nullptr; }
  // False when SQLite refuses.
  bool execute(const std::string& sql);
  // The first column of all rows, as text.
  [[nodiscard]] std::vector<std::string> column(const std::string& sql);
  [[nodiscard]] std::string blob(const std::string& sql);  // of the first row; empty when there is none
  // For a statement with one parameter.
  bool execute_with_blob(const std::string& sql, const std::string& bytes);

  // The row counts and checksums of all tables that have some.
  void sum_up();
  [[nodiscard]] std::string bytes();

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
    void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Close>;
  [[nodiscard]] Statement prepared(const std::string& sql);
  void sum_up(const std::string& table);

  std::unique_ptr<sqlite3, Close> database_;
};

// zlib's way and back; empty when the bytes are not packed.
[[nodiscard]] std::string packed(const std::string& raw);
[[nodiscard]] std::string unpacked(const std::string& packed_bytes);

}  // namespace cairn::fuzz
