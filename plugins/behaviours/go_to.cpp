#include "plugins/behaviours/go_to.hpp"

#include <algorithm>
#include <cstdio>

#include "plugins/behaviours/free_space.hpp"

namespace cairn::behaviours {
namespace {

constexpr int kMostPlans = 12;
constexpr int kMostWaysOut = 3;
constexpr double kPlansApart_s = 1.0;
constexpr double kBlockedAhead_m = 1.0;
constexpr double kBackOff_mps = 0.1;
constexpr double kBackOff_m = 0.15;
constexpr double kBackOffAtMost_s = 3.0;
constexpr double kFace_rad = radians(3.0);
constexpr double kFaceAtMost_s = 15.0;
constexpr double kWayOutClearance_m = 0.1;
constexpr double kWayOutTolerance_m = 0.02;
constexpr std::size_t kMostNamed = 12;
const std::string kNearest = "nearest ";

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i) text += (i == 0 ? "" : ", ") + names[i];
  return text + (names.size() > kMostNamed ? ", ..." : "");
}

std::string known_landmarks(const LandmarkGraph& graph) {
  std::vector<std::string> names;
  for (const auto& [id, landmark] : graph.landmarks())
    names.push_back(label_of(landmark) + (landmark.category.empty() ? "" : " (" + landmark.category + ")"));
  return names.empty() ? "the map holds no landmark" : "the map holds " + list_of(names);
}

NamedLandmarks nearest_of(const std::string& category, const LandmarkGraph& graph) {
  NamedLandmarks named{graph.of_category(category), ""};
  if (!named.ids.empty()) return named;
  std::vector<std::string> categories;
  for (const auto& [id, landmark] : graph.landmarks()) categories.push_back(landmark.category);
  named.unknown = "no landmark of category \"" + category + "\"" + did_you_mean(category, categories) + "; " +
                  known_landmarks(graph);
  return named;
}

}  // namespace

void GoToConfig::describe(Fields<GoToConfig>& fields) {
  using C = GoToConfig;
  fields.raw("landmark", &C::landmark, "text",
             "where to go: a landmark's id (L3) or name, or `nearest CATEGORY`; this or at_m");
  fields.point("at_m", &C::at_m, "m", "where to go: a place of the map");
  fields.angle("angle_deg", &C::angle_rad, {-360.0, 360.0},
               "heading at the end; without it the robot faces the landmark");
  fields.number("tolerance_m", &C::tolerance_m, {0.01, 2.0}, "m", "this near to the end of the plan is there");
  fields.number("speed_mps", &C::speed_mps, {0.01, 5.0}, "m/s", "top speed, within the robot's own limits");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to get there; when it is up the step has failed");
  fields.shorthand("landmark");
}

NamedLandmarks landmarks_named(const std::string& name, const LandmarkGraph& graph) {
  if (name.starts_with(kNearest)) return nearest_of(name.substr(kNearest.size()), graph);
  if (const Landmark* landmark = graph.find_by_name(name)) return {{landmark->id}, ""};
  std::vector<std::string> labels;
  for (const auto& [id, landmark] : graph.landmarks()) labels.push_back(label_of(landmark));
  return {{}, "no landmark \"" + name + "\"" + did_you_mean(name, labels) + "; " + known_landmarks(graph)};
}

GoTo::GoTo(const GoToConfig& config, std::uint64_t seed) : config_(config), seed_(seed) {
  const bool names_landmark = config.landmark.kind != ConfigValue::Kind::null;
  if (names_landmark && config.at_m)
    throw ConfigError(config.landmark.place, "goto: landmark and at_m exclude each other");
  if (!names_landmark && !config.at_m)
    throw ConfigError(config.landmark.place,
                      "goto: needs a landmark (`landmark: nearest square`) or a place (`at_m: [x, y]`)");
  if (names_landmark) landmark_name_ = config_detail::to_text(config.landmark, "landmark");
}

void GoTo::halt() {
  *this = GoTo(config_, seed_);
}

Status GoTo::tick(const WorldView& world, Orders& orders) {
  if (!begun_s_) begun_s_ = world.time_s;
  if (world.time_s - *begun_s_ >= config_.at_most_s)
    return {Progress::failure, "time is up on the way to " + destination(world)};
  switch (mode_) {
    case Mode::plan:
      return plan(world, orders);
    case Mode::travel:
      return travel(world, orders);
    case Mode::back_off:
      return back_off(world, orders);
    case Mode::face:
      break;
  }
  return face(world, orders);
}

Place GoTo::goal_of(const NamedLandmarks& named) const {
  Place goal;
  if (config_.at_m) {
    goal.pose = Pose2{config_.at_m->x(), config_.at_m->y(), config_.angle_rad.value_or(0.0)};
    goal.heading_matters = config_.angle_rad.has_value();
  }
  goal.landmarks = named.ids;
  return goal;
}

Status GoTo::plan(const WorldView& world, Orders& orders) {
  if (plans_ > 0 && world.time_s - planned_s_ < kPlansApart_s) return {Progress::running, "waiting to plan again"};
  NamedLandmarks named;
  if (!config_.at_m) named = landmarks_named(landmark_name_, world.graph);
  if (!named.unknown.empty()) return {Progress::failure, named.unknown};

  PlanRequest request;
  request.from.pose = world.pose.T_map_robot;
  request.to = goal_of(named);
  request.radius_m = world.robot.radius_m;
  request.seed = seed_ + static_cast<std::uint64_t>(plans_);
  ++plans_;
  planned_s_ = world.time_s;
  const PlanResult result = orders.plan(request);
  const auto reached = std::find_if(result.landmarks.rbegin(), result.landmarks.rend(), [&](LandmarkId id) {
    return std::find(named.ids.begin(), named.ids.end(), id) != named.ids.end();
  });
  reached_ = reached != result.landmarks.rend() ? *reached : named.ids.empty() ? 0 : named.ids.front();
  return begin_path(world, result);
}

Status GoTo::begin_path(const WorldView& world, const PlanResult& result) {
  follow_state_ = {};
  on_way_out_ = false;
  path_.clear();
  if (result.outcome == PlanOutcome::solved) {
    for (const Pose2& pose : result.path) path_.push_back(pose.position());
  } else if (result.outcome == PlanOutcome::start_blocked && ways_out_ < kMostWaysOut) {
    // Too near to something to plan: a little further from it first.
    const Pose2& pose = world.pose.T_map_robot;
    path_ = FreeSpace(world.grid, {pose.position(), world.robot.radius_m, kWayOutClearance_m}, {pose}).way_out();
    on_way_out_ = true;
    ++ways_out_;
  }
  if (result.outcome != PlanOutcome::solved && path_.size() < 2)
    return {Progress::failure, std::string(name_of(result.outcome)) + ": " + result.reason};
  mode_ = Mode::travel;
  wanted_ = {};
  watch_.restart();
  return {Progress::running, "going to " + destination(world)};
}

Status GoTo::plan_again(const WorldView& world, Orders& orders, const std::string& why) {
  if (plans_ >= kMostPlans)
    return {Progress::failure,
            why + " on the way to " + destination(world) + ", after " + std::to_string(plans_) + " plans"};
  mode_ = Mode::plan;
  return plan(world, orders);
}

Status GoTo::travel(const WorldView& world, Orders& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  if (watch_.is_stuck(world, wanted_)) {
    mode_ = Mode::back_off;
    mode_since_s_ = world.time_s;
    backed_from_ = pose.position();
    return back_off(world, orders);
  }
  // One cell less than the planner's disc, so that the two never disagree about the same map.
  const double margin_m = std::max(0.0, world.robot.radius_m - world.grid.cell_m());
  if (!on_way_out_ && path_is_blocked(world.grid, path_, follow_state_.along_m, kBlockedAhead_m, margin_m))
    return plan_again(world, orders, "something stands on the path");

  FollowLimits limits = follow_limits(world.robot, config_.speed_mps);
  limits.arrive_m = on_way_out_ ? kWayOutTolerance_m : config_.tolerance_m;
  const FollowStep step = follow(pose, path_, follow_state_, limits);
  follow_state_ = step.state;
  wanted_ = step.wanted;
  if (!step.arrived) {
    orders.drive(wanted_);
  } else if (on_way_out_) {
    mode_ = Mode::plan;
  } else {
    mode_ = Mode::face;
    mode_since_s_ = world.time_s;
  }
  if (on_way_out_) return {Progress::running, "going to " + destination(world)};
  return {Progress::running, "going to " + destination(world), step.left_m / limits.speed_mps};
}

Status GoTo::back_off(const WorldView& world, Orders& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  const std::vector<Point> behind{pose.position(), pose * Point{-kBackOff_m, 0.0}};
  const bool is_over = (pose.position() - backed_from_).norm() >= kBackOff_m ||
                       world.time_s - mode_since_s_ > kBackOffAtMost_s ||
                       path_is_blocked(world.grid, behind, 0.5 * kBackOff_m, kBackOff_m, world.robot.radius_m);
  if (is_over) return plan_again(world, orders, "held back");
  orders.drive({-kBackOff_mps, 0.0});
  return {Progress::running, "backing off"};
}

Status GoTo::face(const WorldView& world, Orders& orders) {
  const Pose2& pose = world.pose.T_map_robot;
  const Landmark* landmark = world.graph.find(reached_);
  double error_rad = 0.0;
  if (config_.angle_rad) {
    error_rad = wrap_angle(*config_.angle_rad - pose.theta_rad);
  } else if (landmark != nullptr) {
    error_rad = heading_error(pose, landmark->T_map_landmark.position());
  }
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  if (!can_turn || std::abs(error_rad) <= kFace_rad || world.time_s - mode_since_s_ > kFaceAtMost_s)
    return {Progress::success, "at " + destination(world)};
  orders.drive(turn_by(error_rad, follow_limits(world.robot, config_.speed_mps).max_w_radps));
  return {Progress::running, "turning to " + destination(world)};
}

std::string GoTo::destination(const WorldView& world) const {
  if (const Landmark* landmark = world.graph.find(reached_))
    return label_of(*landmark) + (landmark->category.empty() ? "" : " (" + landmark->category + ")");
  if (!config_.at_m) return landmark_name_;
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f, %.2f)", config_.at_m->x(), config_.at_m->y());
  return text;
}

}  // namespace cairn::behaviours
