#include "plugins/behaviours/exploring/inspect.hpp"

#include <cstdio>

#include "plugins/behaviours/places/place_name.hpp"

namespace cairn::behaviours {

void InspectConfig::describe(Fields<InspectConfig>& fields) {
  using C = InspectConfig;
  fields.raw("landmark", &C::landmark, "text", "a landmark's id (L3) or name, a category, or `nearest CATEGORY`")
      .required = true;
  fields.number("distance_m", &C::distance_m, {0.1, 5.0}, "m", "from its edge to the robot's centre on an orbit");
  fields.integer("rounds_at_most", &C::rounds_at_most, {1.0, 100.0}, "orbits, whatever the degree does");
  fields.number("gain", &C::gain, {0.0, 1.0}, "",
                "no further orbit when the degree has not risen by more than this in one");
  fields.number("orbit_speed_mps", &C::orbit_speed_mps, {0.01, 5.0}, "m/s", "top speed on an orbit");
  fields.number("speed_mps", &C::speed_mps, {0.01, 5.0}, "m/s", "top speed on the way there");
  fields.number("patience_s", &C::patience_s, {0.1, 3600.0}, "s", "how long it waits for a blockage to go");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "when it is up, it ends with what it has seen");
  fields.group("orbit", &C::orbit, "orbits round the landmark");
  describe_driving(fields);
  fields.shorthand("landmark");
}

Inspect::Inspect(const InspectConfig& config, std::uint64_t seed)
    : config_(config),
      seed_(seed),
      name_(to_landmark_name(config.landmark, "landmark")),
      driver_(config, seed),
      follower_(config.orbit_speed_mps, config.orbit.arrived_m,
                ProgressChecker(config.patience_s, config.driving.progress)),
      landmark_orbit_(config.orbit, config.distance_m, config.driving.local_map) {}

void Inspect::halt() {
  *this = Inspect(config_, seed_);
}

Status Inspect::tick(const WorldView& world, BehaviourContext& context) {
  if (!begun_s_) begun_s_ = world.time_s;
  if (const auto exchange = map_watch_.update(world)) {
    landmark_orbit_.begin_in_new_map(exchange->move);
    follower_.take({});
  }
  if (landmark_ == 0) return begin(world, context);
  const Landmark* const landmark = world.graph.find(landmark_);
  if (landmark == nullptr) return {StepState::failure, lost(landmark_, world.graph)};
  landmark_orbit_.see(world);
  if (world.time_s - *begun_s_ >= config_.at_most_s) {
    if (orbits_ > 0) return finish(*landmark, "time is up");
    return {StepState::failure, "time is up before an orbit round " + described(*landmark) + " was done"};
  }
  switch (mode_) {
    case Mode::drive:
      return drive(world, context, *landmark);
    case Mode::orbit:
      return orbit(world, context, *landmark);
    case Mode::back_off:
      break;
  }
  return back_off(world, context);
}

Status Inspect::begin(const WorldView& world, BehaviourContext& context) {
  const ChosenLandmark chosen = choose_landmark(name_, world, context);
  if (!chosen.unknown.empty()) return {StepState::failure, chosen.unknown};
  landmark_ = chosen.id;
  degree_before_ = degree_at_begin_ = world.graph.find(landmark_)->degree;
  return {StepState::running, "going to " + described(*world.graph.find(landmark_))};
}

Status Inspect::drive(const WorldView& world, BehaviourContext& context, const Landmark& landmark) {
  const bool is_near =
      (landmark.T_map_landmark.position() - world.pose.T_map_robot.position()).norm() <= config_.orbit.near_m &&
      choose_path(world, landmark);
  Status status{StepState::success, ""};
  if (!is_near) {
    Place goal;
    goal.landmarks = {landmark_};
    status = driver_.tick(goal, world, context);
  }
  if (status.state == StepState::running)
    return {StepState::running, status.reason + ", to " + described(landmark), status.left_s};
  if (status.state == StepState::failure)
    return {StepState::failure, "cannot get to " + described(landmark) + ": " + status.reason};
  mode_ = Mode::orbit;
  landmark_orbit_.begin();
  follower_.restart_progress();
  return {StepState::running, "at " + described(landmark)};
}

bool Inspect::choose_path(const WorldView& world, const Landmark& landmark) {
  chosen_s_ = world.time_s;
  std::vector<Point> path = landmark_orbit_.path(world, landmark.T_map_landmark.position());
  if (path.empty()) return false;
  follower_.take(std::move(path));
  return true;
}

Status Inspect::orbit(const WorldView& world, BehaviourContext& context, const Landmark& landmark) {
  const Pose2& pose = world.pose.T_map_robot;
  if (follower_.is_stuck(world)) {
    landmark_orbit_.avoid(pose * Point(config_.orbit.avoid_ahead_m, 0.0));
    mode_ = Mode::back_off;
    backing_since_s_ = world.time_s;
    follower_.stop();
    return back_off(world, context);
  }
  ControlResult step = follower_.ask(context);
  const bool has_arrived = step.state == ControlState::arrived;
  if (follower_.path().empty() || has_arrived || world.time_s - chosen_s_ >= config_.orbit.choose_every_s) {
    const bool was_there = has_arrived && !follower_.path().empty();
    const Point end = was_there ? follower_.path().back() : Point(1e9, 1e9);
    if (!choose_path(world, landmark)) return end_orbit(landmark, context);
    // Arrived, and the sector still counts as open: it cannot be seen from there.
    if (was_there && (follower_.path().back() - end).norm() < config_.orbit.trace_apart_m) landmark_orbit_.avoid(end);
    step = follower_.ask(context);
  }
  follower_.drive(step.twist, context);
  return {StepState::running, "going round " + described(landmark) + ", orbit " + std::to_string(orbits_ + 1)};
}

Status Inspect::back_off(const WorldView& world, BehaviourContext& context) {
  const Pose2& pose = world.pose.T_map_robot;
  const double behind_m = config_.orbit.behind_m;
  const bool is_over = world.time_s - backing_since_s_ > config_.orbit.back_up_s ||
                       path_is_blocked(world.grid, {pose.position(), pose * Point(-behind_m, 0.0)}, 0.5 * behind_m,
                                       behind_m, world.robot.radius_m);
  if (!is_over) {
    context.drive({-config_.orbit.back_up_mps, 0.0});
    return {StepState::running, "backing off"};
  }
  mode_ = Mode::orbit;
  follower_.take({});
  follower_.restart_progress();
  return {StepState::running, "has backed off"};
}

Status Inspect::end_orbit(const Landmark& landmark, BehaviourContext& context) {
  follower_.stop();
  follower_.take({});
  if (!landmark_orbit_.is_covered()) {
    if (orbits_ > 0) return finish(landmark, "it cannot be circled once more");
    return {StepState::failure, described(landmark) + " cannot be circled: no free path leads round it"};
  }
  ++orbits_;
  const double risen = landmark.degree - degree_at_begin_;
  char text[96];
  std::snprintf(text, sizeof text, "orbit %d: degree %.3f -> %.3f", orbits_, degree_at_begin_, landmark.degree);
  context.report(std::string(text) + " of " + described(landmark));
  degree_at_begin_ = landmark.degree;
  landmark_orbit_.begin();
  if (risen <= config_.gain) return finish(landmark, "it rises no more");
  if (orbits_ >= config_.rounds_at_most) return finish(landmark, "that was the last orbit");
  return {StepState::running, "next orbit"};
}

Status Inspect::finish(const Landmark& landmark, const std::string& why) const {
  char text[96];
  std::snprintf(text, sizeof text, "degree %.3f -> %.3f in %d %s", degree_before_, landmark.degree, orbits_,
                orbits_ == 1 ? "orbit" : "orbits");
  return {StepState::success, described(landmark) + ": " + text + ", " + why};
}

}  // namespace cairn::behaviours
