#include "framework/experiments/recognition/places_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "framework/experiments/report.hpp"
#include "framework/experiments/statistics.hpp"

namespace cairn {
namespace {

using Rows = std::vector<const ExperimentRow*>;

// The degrees of one place in all runs that came so far and had looked at its landmark.
std::vector<std::vector<double>> degrees_at(const Rows& rows, std::size_t place) {
  std::vector<std::vector<double>> all;
  for (const ExperimentRow* row : rows)
    if (place < row->places.size() && !row->places[place].degrees.empty()) all.push_back(row->places[place].degrees);
  return all;
}

std::string head(const ExperimentConfig& config) {
  std::vector<std::string> columns{"place", "looks at"};
  for (const char* of : {"", "expected "})
    for (const std::string& category : config.categories) columns.push_back(of + category);
  columns.insert(columns.end(), {"margin", "expected", "true one on top", "runs"});
  return table_head(columns, 2);
}

std::string line(const ExperimentConfig& config, const Rows& rows, std::size_t index) {
  const PlaceConfig& place = config.places[index];
  const auto true_one =
      static_cast<std::size_t>(std::ranges::find(config.categories, place.looks_at) - config.categories.begin());
  const std::vector<std::vector<double>> runs = degrees_at(rows, index);
  std::string text = fmt::format("| {} | {} |", place.name, place.looks_at);
  for (std::size_t k = 0; k < config.categories.size(); ++k) {
    std::vector<double> values;
    values.reserve(runs.size());
    for (const auto& degrees : runs) values.push_back(degrees[k]);
    text += fmt::format(" {} |", text_of(estimate_of(values), 2));
  }
  for (std::size_t k = 0; k < config.categories.size(); ++k)
    text += place.expected.empty() ? " |" : fmt::format(" {:.1f} |", place.expected[k]);
  std::vector<double> margins;
  margins.reserve(runs.size());
  for (const auto& degrees : runs) margins.push_back(margin_of(degrees, true_one));
  const auto on_top = std::ranges::count_if(margins, [](double margin) { return margin > 0.0; });
  return text + fmt::format(" {} | {} | {} | {} |\n", text_of(estimate_of(margins), 2),
                            place.expected.empty() ? "" : fmt::format("{:.1f}", margin_of(place.expected, true_one)),
                            on_top, runs.size());
}

std::string order_text(const ExperimentConfig& config, const Rows& rows) {
  SharedOrder all;
  for (std::size_t i = 0; i < config.places.size(); ++i)
    for (const auto& degrees : degrees_at(rows, i)) {
      const SharedOrder order = shared_order(degrees, config.places[i].expected);
      all.same += order.same;
      all.pairs += order.pairs;
    }
  if (all.pairs == 0) return "";
  return fmt::format("Of the pairs of categories that differ in the expected degrees, {:.0f} % differ the same way.\n",
                     100.0 * all.same / all.pairs);
}

std::string matchings_text(const ExperimentConfig& config, const Rows& rows) {
  std::vector<double> matchings;
  for (const ExperimentRow* row : rows) matchings.push_back(static_cast<double>(row->result.matchings));
  std::string text = "Matchings in a run: " + text_of(estimate_of(matchings), 1);
  if (config.expected_matchings > 0) text += fmt::format(" (expected {})", config.expected_matchings);
  return text + ".\n";
}

}  // namespace

double margin_of(const std::vector<double>& degrees, std::size_t true_category) {
  double other = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < degrees.size(); ++k)
    if (k != true_category) other = std::max(other, degrees[k]);
  return degrees.size() == 1 ? degrees[0] : degrees[true_category] - other;
}

SharedOrder shared_order(const std::vector<double>& degrees, const std::vector<double>& expected) {
  SharedOrder order;
  for (std::size_t a = 0; a < expected.size(); ++a)
    for (std::size_t b = a + 1; b < expected.size(); ++b) {
      if (expected[a] == expected[b]) continue;
      ++order.pairs;
      if ((expected[a] < expected[b]) == (degrees[a] < degrees[b]) && degrees[a] != degrees[b]) ++order.same;
    }
  return order;
}

std::string places_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text;
  for (const std::string& mission : missions_of(rows))
    for (const ExperimentVariant& variant : config.variants) {
      const Rows of_variant = rows_of(rows, mission, variant.name);
      text += fmt::format("## {}, {}\n\nDegrees, mean and 95 % interval over {} seeds.\n\n{}", mission, variant.name,
                          of_variant.size(), head(config));
      for (std::size_t i = 0; i < config.places.size(); ++i) text += line(config, of_variant, i);
      text += "\n" + order_text(config, of_variant) + matchings_text(config, of_variant) + "\n";
    }
  return text;
}

}  // namespace cairn
