#include "plugins/behaviours/errands/go_to.hpp"

#include <cmath>

#include "framework/config/coordinates.hpp"
#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {
void GoToConfig::describe(Fields<GoToConfig>& fields) {
  using C = GoToConfig;
  fields.raw("landmark", &C::landmark, "place",
             "where to go: a landmark's id (L3) or name, a category, `nearest CATEGORY`, or a place `[x, y]`; this, "
             "at_m or input");
  fields.point("at_m", &C::at_m, "m", "where to go: a place of the map");
  fields.input("input", &C::input, "where to go: the place that an earlier step gives by `output` under this name");
  fields.angle("angle_deg", &C::angle_rad, {-360.0, 360.0},
               "heading at the end; without it the robot faces the landmark");
  RouteSettings::describe_route(fields);
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "time to get there; when it is up the step has failed");
  fields.shorthand("landmark");
}

GoTo::GoTo(const GoToConfig& config, std::uint64_t seed) : config_(config), seed_(seed), driver_(config, seed) {
  const bool names_landmark = config.landmark.kind != ConfigValue::Kind::null;
  if (names_landmark && config.at_m)
    throw ConfigError(config.landmark.place, "goto: landmark and at_m exclude each other");
  if (!config.input.empty() && (names_landmark || config.at_m))
    throw ConfigError(config.landmark.place, "goto: input takes the place of landmark and at_m; give one of them");
  if (!names_landmark && !config.at_m && config.input.empty())
    throw ConfigError(config.landmark.place,
                      "goto: needs a landmark (`landmark: nearest square`), a place (`at_m: [x, y]`) or the place that "
                      "an earlier step gives (`input: NAME`)");
  if (const std::optional<Point> at_m = point_in(config.landmark, "goto")) {
    config_.at_m = at_m;
    config_.landmark = {};
  } else if (names_landmark) {
    landmark_name_ = to_landmark_name(config.landmark, "landmark");
  }
}

void GoTo::move_with_map(const WorldView& world) {
  moves_with_map_ = true;
  (void)map_watch_.update(world);
}

void GoTo::halt() {
  *this = GoTo(config_, seed_);
}

// The place that an earlier step gives has moved with the map as the mission keeps it.
void GoTo::begin_in_new_map(const MapMove& move) {
  const bool is_given = !config_.input.empty() || moves_with_map_;
  if (goal_ && goal_->pose && is_given) move_place(move, *goal_->pose);
  if (config_.at_m && moves_with_map_) {
    const Pose2 T = move.near(*config_.at_m);
    config_.at_m = T * *config_.at_m;
    if (config_.angle_rad) config_.angle_rad = wrap_angle(*config_.angle_rad + T.theta_rad);
  }
}

Status GoTo::tick(const WorldView& world, BehaviourContext& context) {
  if (const auto exchange = map_watch_.update(world)) {
    if (exchange->move != nullptr)
      begin_in_new_map(*exchange->move);
    else if (config_.at_m && moves_with_map_)
      return {StepState::failure,
              "the map has been drawn anew, and where " + destination(world) + " lies on it is not known"};
    else
      goal_.reset();  // looked up anew
  }
  if (!begun_s_) begun_s_ = world.time_s;
  if (world.time_s - *begun_s_ >= config_.at_most_s)
    return {StepState::failure, "time is up on the way to " + destination(world)};
  return facing_since_s_ ? face(world, context) : drive_there(world, context);
}

FoundPlace GoTo::find_goal(const WorldView& world, NamedPlaces& context) const {
  FoundPlace found;
  if (config_.at_m) {
    found.place.pose = Pose2{config_.at_m->x(), config_.at_m->y(), config_.angle_rad.value_or(0.0)};
    found.place.heading_matters = config_.angle_rad.has_value();
    return found;
  }
  if (config_.input.empty()) return find_landmarks(landmark_name_, world);
  const std::optional<Place> given = context.input(config_.input);
  if (!given) return {{}, "no step has given the place \"" + config_.input + "\" yet"};
  found.place = *given;
  if (names_retired(found.place, world.graph))
    found.unknown = "of the place \"" + config_.input + "\": " + lost(found.place.landmarks.front(), world.graph);
  return found;
}

Status GoTo::drive_there(const WorldView& world, BehaviourContext& context) {
  if (goal_ && names_retired(*goal_, world.graph)) goal_.reset();
  if (!goal_) {
    driver_.restart();
    FoundPlace found = find_goal(world, context);
    if (!found.unknown.empty()) return {StepState::failure, found.unknown};
    goal_ = std::move(found.place);
  }
  const Status status = driver_.tick(*goal_, world, context);
  if (status.state == StepState::running)
    return {StepState::running, status.reason + ", to " + destination(world), status.left_s};
  if (status.state == StepState::failure)
    return {StepState::failure, status.reason + "; on the way to " + destination(world)};
  facing_since_s_ = world.time_s;
  return face(world, context);
}

Status GoTo::face(const WorldView& world, MotionRequests& context) {
  const Pose2& pose = world.pose.T_map_robot;
  const Landmark* landmark = world.graph.find(driver_.goal_landmark());
  double error_rad = 0.0;
  if (config_.angle_rad) {
    error_rad = wrap_angle(*config_.angle_rad - pose.theta_rad);
  } else if (landmark != nullptr) {
    error_rad = motion::heading_error(pose, landmark->T_map_landmark.position());
  }
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  if (!can_turn || std::abs(error_rad) <= config_.driving.face.faced_rad ||
      world.time_s - *facing_since_s_ > config_.driving.face.at_most_s)
    return {StepState::success, "at " + destination(world)};
  const motion::TurnSettings& turn = config_.driving.turn;
  context.drive(motion::turn_by(error_rad, motion::max_turn_radps(world.robot, turn), turn));
  return {StepState::running, "turning to " + destination(world)};
}

std::string GoTo::destination(const WorldView& world) const {
  if (const Landmark* landmark = world.graph.find(driver_.goal_landmark())) return described(*landmark);
  if (!config_.input.empty()) return "the place \"" + config_.input + "\"";
  return config_.at_m ? described(*config_.at_m) : landmark_name_;
}

}  // namespace cairn::behaviours
