#include "plugins/behaviours/search.hpp"

#include "framework/config/named_category.hpp"

namespace cairn::behaviours {
namespace {

std::string labels_of(const std::vector<LandmarkId>& ids, const LandmarkGraph& graph) {
  std::string text;
  for (const LandmarkId id : ids) text += (text.empty() ? "" : ", ") + label_of(*graph.find(id));
  return text;
}

// To the end: there is no share of the map that is enough.
ExploreConfig exploring(const SearchConfig& config) {
  ExploreConfig explore = config;
  explore.until_known_ratio = 1.0;
  return explore;
}

}  // namespace

void SearchConfig::describe(Fields<SearchConfig>& fields) {
  using C = SearchConfig;
  fields.raw("category", &C::category, "text", "of the landmarks to find, as a template file names it").required = true;
  fields.integer("until", &C::until, {1.0, 1e6}, "so many landmarks of the category must be known");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to search; when it is up the step has failed");
  describe_ways(fields);
  fields.shorthand("category");
}

Search::Search(const SearchConfig& config, const std::vector<std::string>& categories)
    : config_(config), category_(config_detail::to_text(config.category, "category")), explore_(exploring(config)) {
  check_category_is_known(category_, config.category.place, "search", categories);
}

void Search::halt() {
  explore_.halt();
}

Status Search::tick(const WorldView& world, Orders& orders) {
  const std::vector<LandmarkId> found = world.graph.of_category(category_);
  if (found.size() >= static_cast<std::size_t>(config_.until))
    return {Progress::success, "found " + category_ + ": " + labels_of(found, world.graph)};
  const Status status = explore_.tick(world, orders);
  const std::string count = std::to_string(found.size()) + " of " + std::to_string(config_.until) + " " + category_ +
                            " found" + (found.empty() ? "" : " (" + labels_of(found, world.graph) + ")");
  if (status.progress == Progress::running) return {Progress::running, status.reason + "; " + count, status.left_s};
  return {Progress::failure, count + "; " + status.reason};
}

}  // namespace cairn::behaviours
