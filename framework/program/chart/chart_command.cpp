// `cairn chart`: draws the tables of a Markdown file, so that a chart is made again without its experiment.

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "framework/program/chart/text_table.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/output_files.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "maps/pictures/drawing/chart.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxMarkedRows = 60;  // more are a line without marks

std::string text_of_tables(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return text;
}

bool is_of_numbers(const TextTable& table, std::size_t column) {
  return !table.rows.empty() && std::ranges::all_of(table.rows, [&](const std::vector<std::string>& row) {
    return row[column].empty() || value_of(row[column]).has_value();
  });
}

// The columns that are drawn over the first one: those that are named, as far as the table has them, or all of numbers.
std::vector<std::size_t> drawn_columns(const TextTable& table, const std::vector<std::string>& names) {
  std::vector<std::size_t> columns;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(table.columns, name);
    if (found != table.columns.end()) columns.push_back(static_cast<std::size_t>(found - table.columns.begin()));
  }
  for (std::size_t c = 1; names.empty() && c < table.columns.size(); ++c)
    if (is_of_numbers(table, c)) columns.push_back(c);
  return columns;
}

Series series_of(const TextTable& table, std::size_t column, bool over_numbers) {
  const bool is_long = table.rows.size() > kMaxMarkedRows;
  Series series{table.columns[column], {}, is_long ? SeriesStyle::lines : SeriesStyle::lines_and_points, {}};
  bool has_intervals = false;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto value = value_of(table.rows[r][column]);
    if (!value) continue;
    const double x = over_numbers ? value_of(table.rows[r].front())->value : static_cast<double>(r);
    series.points.emplace_back(x, value->value);
    const auto [low, high] = value->interval.value_or(std::pair(value->value, value->value));
    series.ends.emplace_back(low, high);
    has_intervals |= value->interval.has_value();
  }
  if (!has_intervals) series.ends.clear();
  return series;
}

Chart chart_of(const TextTable& table, const std::vector<std::size_t>& columns, const ChartCommand& command) {
  Chart chart;
  chart.title = command.title.empty() ? table.heading : command.title;
  if (const std::size_t mark = chart.title.find("{}"); mark != std::string::npos)
    chart.title.replace(mark, 2, table.heading);
  chart.x_label = table.columns.front();
  chart.y_label = command.y_label;
  if (chart.y_label.empty()) chart.y_label = columns.size() == 1 ? table.columns[columns.front()] : "";
  chart.of_shares_over_x = command.of_shares;
  const bool over_numbers = std::ranges::all_of(
      table.rows, [](const std::vector<std::string>& row) { return value_of(row.front()).has_value(); });
  if (!over_numbers)
    for (const std::vector<std::string>& row : table.rows) chart.x_names.push_back(row.front());
  for (const std::size_t column : columns) chart.series.push_back(series_of(table, column, over_numbers));
  return chart;
}

std::string picture_name(const std::string& prefix, const std::string& heading, std::size_t number) {
  std::string name = heading.empty() ? "table_" + std::to_string(number) : heading;
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == '/'; }, '_');
  return prefix + name + ".png";
}

void check_columns(const std::vector<TextTable>& tables, const ChartCommand& command) {
  std::vector<std::string> known;
  for (const TextTable& table : tables) known.insert(known.end(), table.columns.begin(), table.columns.end());
  for (const std::string& name : command.columns)
    if (std::ranges::find(known, name) == known.end())
      throw std::runtime_error(command.file.string() + ": no table has a column " + in_quotes(name) +
                               did_you_mean(name, known));
}

}  // namespace

int chart(const ChartCommand& command, const CommonOptions& common) {
  const std::vector<TextTable> tables = tables_of(text_of_tables(command.file));
  check_columns(tables, command);
  make_folder(command.out);
  nlohmann::ordered_json pictures = nlohmann::ordered_json::array();
  std::string lines;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::vector<std::size_t> columns = drawn_columns(tables[i], command.columns);
    if (columns.empty()) continue;
    const std::filesystem::path file = command.out / picture_name(command.prefix, tables[i].heading, i + 1);
    const ChartOutcome outcome = write_chart(file, chart_of(tables[i], columns, command));
    if (!outcome.drawn) throw std::runtime_error(file.string() + ": " + outcome.reason);
    pictures.push_back(file.string());
    lines += "wrote " + file.string() + "\n";
  }
  if (pictures.empty()) throw std::runtime_error(command.file.string() + ": holds no table with a column of numbers");
  print({{"pictures", pictures}}, lines, common);
  return kExitDone;
}

}  // namespace cairn
