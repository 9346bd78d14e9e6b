#include "plugins/table_log/table_file.hpp"

#include <cmath>

#include "maps/base/text.hpp"
#include "plugins/common/logs/log_line.hpp"
#include "plugins/common/logs/log_text.hpp"

namespace cairn {
namespace {

constexpr std::string_view kBlank = " \t";

TableField field_at(std::string_view line, std::size_t begin, std::size_t end) {
  const std::string_view text = trimmed(line.substr(begin, end - begin));
  return {text, static_cast<int>(text.data() - line.data()) + 1};
}

std::vector<TableField> cut(std::string_view line, Separator separator) {
  std::vector<TableField> fields;
  if (separator == Separator::whitespace) {
    std::size_t begin = line.find_first_not_of(kBlank);
    while (begin != std::string_view::npos) {
      const std::size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
      fields.push_back(field_at(line, begin, end));
      begin = line.find_first_not_of(kBlank, end);
    }
    return fields;
  }
  const char mark = separator == Separator::comma ? ',' : separator == Separator::semicolon ? ';' : '\t';
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(line.find(mark, begin), line.size());
    fields.push_back(field_at(line, begin, end));
    if (end == line.size()) return fields;
    begin = end + 1;
  }
}

}  // namespace

SourcePlace TableRow::place(int column) const {
  if (column >= 1 && static_cast<std::size_t>(column) <= fields_.size())
    return {file_, line_, fields_[column - 1].column};
  if (fields_.empty()) return {file_, line_, 1};
  return {file_, line_, fields_.back().column + static_cast<int>(fields_.back().text.size())};
}

double TableRow::number(int column, const std::string& what) const {
  if (static_cast<std::size_t>(column) > fields_.size()) {
    throw ConfigError(place(column), "the line has " + std::to_string(fields_.size()) + " columns, but column " +
                                         std::to_string(column) + " is to be the " + what);
  }
  const std::string_view text = fields_[column - 1].text;
  double value = 0.0;
  if (!log_common::read_number(text, value)) {
    throw ConfigError(place(column), "the " + what + " (column " + std::to_string(column) + ") must be a number, not " +
                                         shown(fields_[column - 1].text));
  }
  return value;
}

double TableRow::finite_number(int column, const std::string& what) const {
  const double value = number(column, what);
  if (!std::isfinite(value)) {
    throw ConfigError(place(column), "the " + what + " (column " + std::to_string(column) + ") must be finite, not " +
                                         shown(fields_[column - 1].text));
  }
  return value;
}

TableFile::TableFile(const TableConfig& config) : name_(config.file.string()) {
  text_ = log_common::text_of_file(config.file);
  std::string_view rest = text_;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // a byte order mark
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::string_view content = trimmed(line);
    if (line_number <= config.skip_lines || content.empty()) continue;
    if (!config.comment.empty() && content.starts_with(config.comment)) continue;
    rows_.emplace_back(name_, line_number, cut(line, config.separator));
  }
}

}  // namespace cairn
