// A text file of columns, cut into rows of fields that know their place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/config/config_value.hpp"
#include "plugins/table_log/config.hpp"

namespace cairn {

struct TableField {
  std::string_view text;
  int column = 0;  // of its first character, from 1
};

class TableRow {
 public:
  TableRow(std::string file, int line, std::vector<TableField> fields)
      : file_(std::move(file)), line_(line), fields_(std::move(fields)) {}

  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] std::size_t size() const { return fields_.size(); }
  // Where a column (from 1) stands, or where it would have to begin.
  [[nodiscard]] SourcePlace place(int column) const;
  // The number in a column; what: what it is for people. "nan" and "inf" are numbers.
  // Throws ConfigError when the row is too short or the field is no number.
  [[nodiscard]] double number(int column, const std::string& what) const;
  // The same, but neither NaN nor infinite.
  [[nodiscard]] double finite_number(int column, const std::string& what) const;

 private:
  std::string file_;
  int line_;
  std::vector<TableField> fields_;
};

class TableFile {
 public:
  // Plain or gzip. Throws ConfigError when the file cannot be read or its compressed data is damaged.
  // The rows view into this object.
  explicit TableFile(const TableConfig& config);
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::vector<TableRow>& rows() const { return rows_; }

 private:
  std::string name_;
  std::string text_;
  std::vector<TableRow> rows_;
};

}  // namespace cairn
