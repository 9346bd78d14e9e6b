#include "plugins/behaviours/errands/search.hpp"

#include <algorithm>

#include "framework/config/named_category.hpp"
#include "plugins/behaviours/places/place_name.hpp"

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

RouteSettings driving(const SearchConfig& config) {
  RouteSettings settings;
  settings.speed_mps = config.speed_mps;
  settings.driving = config.driving;
  return settings;
}

}  // namespace

void SearchRoundSettings::describe(Fields<SearchRoundSettings>& fields) {
  using C = SearchRoundSettings;
  fields.number("pause_s", &C::pause_s, {0.0, 3600.0}, "s", "it waits before it looks at all once more");
  fields.number("to_room_at_most_s", &C::to_room_at_most_s, {0.0, 3600.0}, "s",
                "time to try to get into a room that was out of reach");
  fields.number("been_apart_m", &C::been_apart_m, {0.01, 50.0}, "m",
                "where it has been is remembered at this spacing: rooms there are not tried");
}

void SearchConfig::describe(Fields<SearchConfig>& fields) {
  using C = SearchConfig;
  fields.raw("category", &C::category, "text", "of the landmarks to find, as a template file names it").required = true;
  fields.raw(
      "at", &C::at, "place",
      "where the search begins, `[x, y]`, a landmark's or cluster's id or name, or `nearest CATEGORY`; without it, "
      "where the robot is");
  fields.integer("until", &C::until, {1.0, 1e6}, "so many landmarks of the category must be known");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to search; when it is up the step has failed");
  fields.integer("rounds", &C::rounds, {1.0, 1e6},
                 "all is looked at so often before the search is given up: doors open, people leave");
  fields.output("output", &C::output,
                "the landmarks found are given under this name to later steps, such as `goto: {input: NAME}`");
  fields.group("between_rounds", &C::between_rounds, "what it does between two rounds");
  describe_exploring(fields);
  fields.shorthand("category");
}

Search::Search(const SearchConfig& config, std::uint64_t seed, const std::vector<std::string>& categories)
    : config_(config),
      category_(config_detail::to_text(config.category, "category")),
      explore_(exploring(config)),
      driver_(driving(config), seed) {
  if (config.at.kind != ConfigValue::Kind::null) begin_at_ = to_place_name(config.at, "at");
  check_category_is_known(category_, config.category.place, "search", categories);
}

void Search::halt() {
  explore_.halt();
  begun_s_.reset();
  waits_since_s_.reset();
  room_.reset();
  been_at_.clear();
  driver_.restart();
  begin_.reset();
  has_begun_there_ = false;
  round_ = 1;
}

// Where it has been, and where it goes; a place that the mission's file gives is what it is.
void Search::begin_in_new_map(const MapMove* move) {
  if (move == nullptr) {
    been_at_.clear();
    if (room_) driver_.restart();
    room_.reset();
    return;
  }
  move_places(*move, been_at_);
  if (room_) move_place(*move, *room_->pose);
}

std::string Search::in_round() const {
  return " in round " + std::to_string(round_) + " of " + std::to_string(config_.rounds);
}

// Nothing once the robot is where the search begins.
std::optional<Status> Search::go_to_begin(const WorldView& world, BehaviourContext& context) {
  if (!begin_at_ || has_begun_there_) return std::nullopt;
  if (begin_ && names_retired(*begin_, world.graph)) begin_.reset();
  if (!begin_) {
    FoundPlace found = find_place(*begin_at_, world);
    if (!found.unknown.empty()) return Status{StepState::failure, found.unknown};
    begin_ = std::move(found.place);
    driver_.restart();
  }
  const Status status = driver_.tick(*begin_, world, context);
  if (status.state == StepState::running)
    return Status{StepState::running, status.reason + ", to " + begin_at_->text + ", where the search begins"};
  if (status.state == StepState::failure)
    return Status{StepState::failure, status.reason + "; on the way to " + begin_at_->text};
  driver_.restart();
  has_begun_there_ = true;
  return std::nullopt;
}

// What it does while it does not explore.
std::optional<Status> Search::between(const WorldView& world, BehaviourContext& context) {
  if (waits_since_s_ && world.time_s - *waits_since_s_ < config_.between_rounds.pause_s) {
    context.drive({});
    return Status{StepState::running, "waiting before it looks at all once more"};
  }
  waits_since_s_.reset();
  if (!room_) return std::nullopt;
  const Status status = driver_.tick(*room_, world, context);
  const std::string place = described(room_->pose->position());
  const bool is_late = world.time_s - to_room_since_s_ >= config_.between_rounds.to_room_at_most_s;
  if (status.state == StepState::running && !is_late)
    return Status{StepState::running, "trying to get to " + place + " (" + status.reason + ")"};
  if (status.state != StepState::success)
    context.report("does not get to " + place + ": " + (is_late ? "it takes too long" : status.reason));
  driver_.restart();
  room_.reset();
  return std::nullopt;
}

Status Search::nothing_left(const std::string& found, const std::string& why, const WorldView& world,
                            BehaviourContext& context) {
  const std::string so_far = found + in_round() + ": " + why;
  const std::optional<Point> place = explore_.room_out_of_reach(world, been_at_);
  if (place) {
    context.report(so_far + "; tries to get to " + described(*place));
    been_at_.push_back(*place);
    room_ = Place{Pose2{place->x(), place->y(), 0.0}, false, {}};
    to_room_since_s_ = world.time_s;
    return {StepState::running, "trying to get to " + described(*place)};
  }
  if (round_ >= config_.rounds) return {StepState::failure, so_far};
  context.report(so_far + "; looks at all once more");
  explore_.halt();
  been_at_.clear();
  ++round_;
  waits_since_s_ = world.time_s;
  return {StepState::running, "looks at all once more"};
}

Status Search::tick(const WorldView& world, BehaviourContext& context) {
  if (const auto exchange = map_watch_.update(world)) begin_in_new_map(exchange->move);
  const std::vector<LandmarkId> found = world.graph.of_category(category_);
  if (found.size() >= static_cast<std::size_t>(config_.until)) {
    if (!config_.output.empty()) context.output(config_.output, Place{std::nullopt, false, found});
    return {StepState::success, "found " + category_ + ": " + labels_of(found, world.graph)};
  }
  if (!begun_s_) begun_s_ = world.time_s;
  const std::string count = std::to_string(found.size()) + " of " + std::to_string(config_.until) + " " + category_ +
                            " found" + (found.empty() ? "" : " (" + labels_of(found, world.graph) + ")");
  const double left_s = *begun_s_ + config_.at_most_s - world.time_s;
  if (left_s <= 0.0) return {StepState::failure, count + "; time is up" + in_round()};
  const Point here = world.pose.T_map_robot.position();
  if (std::ranges::none_of(been_at_,
                           [&](const Point& p) { return (p - here).norm() < config_.between_rounds.been_apart_m; }))
    been_at_.push_back(here);
  Status status;
  if (const std::optional<Status> first = go_to_begin(world, context)) {
    status = *first;
  } else if (const std::optional<Status> now = between(world, context)) {
    status = *now;
  } else {
    status = explore_.tick(world, context);
    if (status.state == StepState::success || explore_.has_nothing_left())
      status = nothing_left(count, status.reason, world, context);
    else if (status.state == StepState::failure)
      status.reason = count + "; " + status.reason;
  }
  if (status.state != StepState::running) return status;
  return {StepState::running, status.reason + "; " + count, std::min(status.left_s.value_or(left_s), left_s)};
}

}  // namespace cairn::behaviours
