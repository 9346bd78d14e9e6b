#include "plugins/behaviours/search.hpp"

#include <algorithm>

#include "framework/config/named_category.hpp"
#include "plugins/behaviours/openings.hpp"
#include "plugins/behaviours/place_name.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kPause_s = 10.0;  // between two rounds: somebody may make room
constexpr double kToRoomAtMost_s = 120.0;

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

RouteSettings driving(const SearchConfig& config) {
  RouteSettings settings;
  settings.speed_mps = config.speed_mps;
  return settings;
}

}  // namespace

void SearchConfig::describe(Fields<SearchConfig>& fields) {
  using C = SearchConfig;
  fields.raw("category", &C::category, "text", "of the landmarks to find, as a template file names it").required = true;
  fields.integer("until", &C::until, {1.0, 1e6}, "so many landmarks of the category must be known");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to search; when it is up the step has failed");
  fields.integer("rounds", &C::rounds, {1.0, 1e6},
                 "all is looked at so often before the search is given up: doors open, people go on");
  describe_ways(fields);
  fields.shorthand("category");
}

Search::Search(const SearchConfig& config, std::uint64_t seed, const std::vector<std::string>& categories)
    : config_(config),
      category_(config_detail::to_text(config.category, "category")),
      explore_(exploring(config)),
      driver_(driving(config), seed) {
  check_category_is_known(category_, config.category.place, "search", categories);
}

void Search::halt() {
  explore_.halt();
  begun_s_.reset();
  between_since_s_.reset();
  room_.reset();
  tried_rooms_.clear();
  driver_.restart();
  round_ = 1;
}

void Search::begin_round(const WorldView& world) {
  explore_.halt();
  ++round_;
  between_since_s_ = world.time_s;
  const Point here = world.pose.T_map_robot.position();
  const FreeSpace space(world.grid, {here, world.robot.radius_m, config_.clearance_m}, {world.pose.T_map_robot});
  const std::optional<Point> place = room_out_of_reach(space, here, tried_rooms_);
  if (!place) return;
  tried_rooms_.push_back(*place);
  room_ = Place{Pose2{place->x(), place->y(), 0.0}, false, {}, {}};
}

bool Search::is_between_rounds(const WorldView& world, Orders& orders) {
  if (!between_since_s_) return false;
  const double since_s = world.time_s - *between_since_s_;
  if (room_ && since_s < kToRoomAtMost_s && driver_.tick(*room_, world, orders).progress == Progress::running)
    return true;
  if (!room_ && since_s < kPause_s) {
    orders.drive({});
    return true;
  }
  if (room_) driver_.restart();
  room_.reset();
  between_since_s_.reset();
  return false;
}

Status Search::tick(const WorldView& world, Orders& orders) {
  const std::vector<LandmarkId> found = world.graph.of_category(category_);
  if (found.size() >= static_cast<std::size_t>(config_.until))
    return {Progress::success, "found " + category_ + ": " + labels_of(found, world.graph)};
  if (!begun_s_) begun_s_ = world.time_s;
  const std::string count = std::to_string(found.size()) + " of " + std::to_string(config_.until) + " " + category_ +
                            " found" + (found.empty() ? "" : " (" + labels_of(found, world.graph) + ")");
  const double left_s = *begun_s_ + config_.at_most_s - world.time_s;
  if (left_s <= 0.0) return {Progress::failure, count + "; time is up in round " + std::to_string(round_)};
  if (is_between_rounds(world, orders))
    return {Progress::running,
            (room_ ? "trying to get to " + described(room_->pose->position())
                   : "waiting before it looks at all once more") +
                "; " + count,
            left_s};
  const Status status = explore_.tick(world, orders);
  if (status.progress == Progress::running)
    return {Progress::running, status.reason + "; " + count,
            status.left_s ? std::min(*status.left_s, left_s) : status.left_s};
  if (status.progress == Progress::success && round_ < config_.rounds) {
    orders.say(count + " in round " + std::to_string(round_) + " of " + std::to_string(config_.rounds) + ": " +
               status.reason);
    begin_round(world);
    return {Progress::running, "looks at all once more; " + count, left_s};
  }
  return {Progress::failure, count + "; " + status.reason};
}

}  // namespace cairn::behaviours
