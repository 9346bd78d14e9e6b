// Tables of results as experiments write them into table.md, and as the pages of docs/results hold them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cairn {

struct TextTable {
  std::string heading;  // of the section that it stands in, without the marks; after a colon only what follows it
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // a cell a column
};
// All tables of a Markdown text, in its order.
[[nodiscard]] std::vector<TextTable> tables_of(const std::string& markdown);

// "0.8", "0.8 (0.376 - 0.964)", "0.8 +- 0.1".
struct CellValue {
  double value = 0.0;
  std::optional<std::pair<double, double>> interval{};
};
// None where the cell is empty or no number.
[[nodiscard]] std::optional<CellValue> value_of(const std::string& cell);

}  // namespace cairn
