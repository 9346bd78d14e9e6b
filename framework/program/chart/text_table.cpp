#include "framework/program/chart/text_table.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "maps/base/text.hpp"

namespace cairn {
namespace {

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells;
  line = trimmed(line);
  line.remove_prefix(1);
  while (!line.empty()) {
    const std::size_t end = std::min(line.find('|'), line.size());
    cells.emplace_back(trimmed(line.substr(0, end)));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return cells;
}

// "|---|---:|"
bool is_rule(std::string_view line) {
  return line.find_first_not_of("|-: ") == std::string_view::npos && line.find("--") != std::string_view::npos;
}

std::string heading_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of('#'), line.size()));
  if (const std::size_t colon = line.rfind(": "); colon != std::string_view::npos) line.remove_prefix(colon + 2);
  return std::string(trimmed(line));
}

}  // namespace

std::vector<TextTable> tables_of(const std::string& markdown) {
  std::vector<TextTable> tables;
  std::istringstream lines(markdown);
  std::string heading;
  std::string before;
  bool is_in_table = false;
  for (std::string line; std::getline(lines, line); before = line) {
    if (line.starts_with('#')) heading = heading_of(line);
    if (!line.starts_with('|')) {
      is_in_table = false;
    } else if (is_rule(line) && before.starts_with('|') && !is_in_table) {
      tables.push_back({heading, cells_of(before), {}});
      is_in_table = true;
    } else if (is_in_table) {
      std::vector<std::string> cells = cells_of(line);
      cells.resize(tables.back().columns.size());
      tables.back().rows.push_back(std::move(cells));
    }
  }
  return tables;
}

std::optional<CellValue> value_of(const std::string& cell) {
  const std::size_t end = std::min(cell.find(' '), cell.size());
  const auto value = number_from<double>(std::string_view(cell).substr(0, end));
  if (!value) return std::nullopt;
  CellValue result{*value, std::nullopt};
  std::string_view rest = trimmed(std::string_view(cell).substr(end));
  if (rest.empty()) return result;
  if (rest.starts_with("+- ")) {
    const auto half_width = number_from<double>(trimmed(rest.substr(3)));
    if (!half_width) return std::nullopt;
    result.interval = {*value - *half_width, *value + *half_width};
    return result;
  }
  const std::size_t middle = rest.find(" - ");
  if (!rest.starts_with('(') || !rest.ends_with(')') || middle == std::string_view::npos) return std::nullopt;
  const auto low = number_from<double>(rest.substr(1, middle - 1));
  const auto high = number_from<double>(rest.substr(middle + 3, rest.size() - middle - 4));
  if (!low || !high) return std::nullopt;
  result.interval = {*low, *high};
  return result;
}

}  // namespace cairn
