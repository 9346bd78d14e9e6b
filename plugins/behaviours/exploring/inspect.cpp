#include "plugins/behaviours/exploring/inspect.hpp"

#include <algorithm>
#include <cstdio>

#include "plugins/behaviours/errands/place_name.hpp"

namespace cairn::behaviours {
namespace {

CellGroup object_at(const FreeSpace& space, const Point& centre, const InspectOrbitSettings& settings) {
  CellGroup best;
  double nearest_m = settings.is_landmark_m;
  for (CellGroup& object : compact_objects(space, settings.largest_object_m, settings.object)) {
    Point sum{0.0, 0.0};
    for (const Cell c : object) sum += space.centre_of(c);
    const double distance_m = (sum / static_cast<double>(object.size()) - centre).norm();
    if (distance_m > nearest_m) continue;
    nearest_m = distance_m;
    best = std::move(object);
  }
  if (!best.empty()) return best;
  const Cell middle = space.cell_at(centre);
  const int reach = settings.usual_outline_cells;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) best.push_back(middle + Cell{dx, dy});
  return best;
}

}  // namespace

void InspectOrbitSettings::describe(Fields<InspectOrbitSettings>& fields) {
  using C = InspectOrbitSettings;
  fields.number("near_m", &C::near_m, {0.1, 50.0}, "m", "a lap begins when the robot is this near to the landmark");
  fields.number("around_m", &C::around_m, {0.5, 100.0}, "m", "the part of the map round both that is searched");
  fields.number("clearance_m", &C::clearance_m, {0.0, 5.0}, "m", "room that a lap keeps beside the robot");
  fields.number("further_m", &C::further_m, {0.0, 5.0}, "m", "a lap may lead further from the landmark by this");
  fields.number("largest_object_m", &C::largest_object_m, {0.1, 20.0}, "m", "what is longer is a wall");
  fields.number("is_landmark_m", &C::is_landmark_m, {0.0, 10.0}, "m",
                "the object this near to the landmark's place is the landmark");
  fields.integer("usual_outline_cells", &C::usual_outline_cells, {0.0, 1000.0},
                 "a landmark that the map does not show is taken to reach so far to each side");
  fields.number("choose_every_s", &C::choose_every_s, {0.1, 600.0}, "s", "the lap's path is chosen anew this often");
  fields.number("trace_apart_m", &C::trace_apart_m, {0.01, 5.0}, "m",
                "where the robot was is remembered at this "
                "spacing");
  fields.integer("min_covered_sectors", &C::min_covered_sectors, {1.0, 24.0}, "fewer of 24 directions are no lap");
  fields.number("arrived_m", &C::arrived_m, {0.001, 1.0}, "m", "this near to the end of a lap's path is there");
  fields.number("avoid_ahead_m", &C::avoid_ahead_m, {0.0, 10.0}, "m",
                "where it was blocked, the lap leaves out the place this far ahead");
  fields.number("back_up_mps", &C::back_up_mps, {0.001, 1.0}, "m/s", "then it backs up at this speed");
  fields.number("back_up_s", &C::back_up_s, {0.0, 600.0}, "s", "for so long");
  fields.number("behind_m", &C::behind_m, {0.01, 10.0}, "m", "while this much behind it is free");
  fields.group("object", &C::object, "what is an object that stands free");
}

void InspectConfig::describe(Fields<InspectConfig>& fields) {
  using C = InspectConfig;
  fields.raw("landmark", &C::landmark, "text", "a landmark's id (L3) or name, or `nearest CATEGORY`").required = true;
  fields.number("distance_m", &C::distance_m, {0.1, 5.0}, "m", "from its edge to the robot's centre on a lap");
  fields.integer("rounds_at_most", &C::rounds_at_most, {1.0, 100.0}, "laps, whatever the degree does");
  fields.number("gain", &C::gain, {0.0, 1.0}, "", "no lap more when the degree has not risen by more than this in one");
  fields.number("orbit_speed_mps", &C::orbit_speed_mps, {0.01, 5.0}, "m/s", "top speed on a lap");
  fields.number("speed_mps", &C::speed_mps, {0.01, 5.0}, "m/s", "top speed on the way there");
  fields.number("patience_s", &C::patience_s, {0.1, 3600.0}, "s", "how long it waits for a blockage to go");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "when it is up, it ends with what it has seen");
  fields.group("orbit", &C::orbit, "laps round the landmark");
  describe_driving(fields);
  fields.shorthand("landmark");
}

Inspect::Inspect(const InspectConfig& config, std::uint64_t seed)
    : config_(config),
      seed_(seed),
      name_(to_landmark_name(config.landmark, "landmark")),
      driver_(config, seed),
      progress_(config.patience_s, config.driving.progress) {}

void Inspect::halt() {
  *this = Inspect(config_, seed_);
}

Status Inspect::tick(const WorldView& world, BehaviourContext& context) {
  if (!begun_s_) begun_s_ = world.time_s;
  if (landmark_ == 0) return begin(world, context);
  const Landmark* const landmark = world.graph.find(landmark_);
  if (landmark == nullptr) return {Progress::failure, lost(landmark_, world.graph)};
  remember(world);
  if (world.time_s - *begun_s_ >= config_.at_most_s) {
    if (orbits_ > 0) return finish(*landmark, "time is up");
    return {Progress::failure, "time is up before a lap round " + described(*landmark) + " was done"};
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

void Inspect::remember(const WorldView& world) {
  const Pose2& pose = world.pose.T_map_robot;
  if (!near_echoes_) near_echoes_.emplace(world.grid, config_.driving.local_map.echoes.near);
  if (world.observation != nullptr) near_echoes_->see(*world.observation, pose);
  near_echoes_->stand_at(pose.position(), world.robot.radius_m);
  if (trace_.empty() || (trace_.back().position() - pose.position()).norm() >= config_.orbit.trace_apart_m)
    trace_.push_back(pose);
}

Status Inspect::begin(const WorldView& world, BehaviourContext& context) {
  const ChosenLandmark chosen = choose_landmark(name_, world, context);
  if (!chosen.unknown.empty()) return {Progress::failure, chosen.unknown};
  landmark_ = chosen.id;
  degree_before_ = degree_at_lap_ = world.graph.find(landmark_)->degree;
  return {Progress::running, "going to " + described(*world.graph.find(landmark_))};
}

Status Inspect::drive(const WorldView& world, BehaviourContext& context, const Landmark& landmark) {
  const bool is_near =
      (landmark.T_map_landmark.position() - world.pose.T_map_robot.position()).norm() <= config_.orbit.near_m &&
      choose_path(world, landmark);
  Status status{Progress::success, ""};
  if (!is_near) {
    Place goal;
    goal.landmarks = {landmark_};
    status = driver_.tick(goal, world, context);
  }
  if (status.progress == Progress::running)
    return {Progress::running, status.reason + ", to " + described(landmark), status.left_s};
  if (status.progress == Progress::failure)
    return {Progress::failure, "cannot get to " + described(landmark) + ": " + status.reason};
  mode_ = Mode::orbit;
  orbit_begins_ = trace_.size();
  progress_.restart();
  return {Progress::running, "at " + described(landmark)};
}

bool Inspect::choose_path(const WorldView& world, const Landmark& landmark) {
  chosen_s_ = world.time_s;
  const Pose2& pose = world.pose.T_map_robot;
  const Point centre = landmark.T_map_landmark.position();
  const Cell here = world.grid.cell_at(pose.position());
  const Cell there = world.grid.cell_at(centre);
  const int reach = static_cast<int>(config_.orbit.around_m / world.grid.cell_m());
  const CellBox part = united(CellBox{here, here + Cell{1, 1}}, CellBox{there, there + Cell{1, 1}}).grown(reach);
  const FreeSpace space(
      near_echoes_->applied_to(world.grid, part),
      {pose.position(), world.robot.radius_m, config_.orbit.clearance_m, config_.driving.local_map.paths}, trace_);
  const OrbitSettings settings{config_.distance_m, config_.distance_m + config_.orbit.further_m,
                               config_.orbit.largest_object_m, config_.orbit.object};
  const auto of_orbit = std::span(trace_).subspan(std::min(orbit_begins_, trace_.size()));
  const Orbit round = orbit_round(space, object_at(space, centre, config_.orbit), of_orbit, avoid_, settings);
  covered_ = round.count(SectorState::covered);
  if (round.count(SectorState::open) == 0) return false;
  path_.take(orbit_route(space, round, pose).path);
  return !path_.empty();
}

Status Inspect::orbit(const WorldView& world, BehaviourContext& context, const Landmark& landmark) {
  const Pose2& pose = world.pose.T_map_robot;
  if (progress_.is_stuck(world, wanted_)) {
    avoid_.push_back(pose * Point(config_.orbit.avoid_ahead_m, 0.0));
    mode_ = Mode::back_off;
    backing_since_s_ = world.time_s;
    wanted_ = {};
    return back_off(world, context);
  }
  ControlResult step = follow_path(context);
  const bool has_arrived = step.state == ControlState::arrived;
  if (path_.empty() || has_arrived || world.time_s - chosen_s_ >= config_.orbit.choose_every_s) {
    const bool was_there = has_arrived && !path_.empty();
    const Point end = was_there ? path_.points().back() : Point(1e9, 1e9);
    if (!choose_path(world, landmark)) return end_orbit(landmark, context);
    // Arrived, and the sector still counts as open: it cannot be seen from there.
    if (was_there && (path_.points().back() - end).norm() < config_.orbit.trace_apart_m) avoid_.push_back(end);
    step = follow_path(context);
  }
  wanted_ = step.twist;
  context.drive(wanted_);
  return {Progress::running, "going round " + described(landmark) + ", lap " + std::to_string(orbits_ + 1)};
}

// As near to the object as the lap leads: only the collision monitor stops it.
ControlResult Inspect::follow_path(BehaviourContext& context) {
  ControlRequest request = path_.request();
  request.speed_mps = config_.orbit_speed_mps;
  request.tolerance_m = config_.orbit.arrived_m;
  request.avoids_obstacles = false;
  const ControlResult result = context.control(request);
  path_.record(result);
  return result;
}

Status Inspect::back_off(const WorldView& world, BehaviourContext& context) {
  const Pose2& pose = world.pose.T_map_robot;
  const double behind_m = config_.orbit.behind_m;
  const bool is_over = world.time_s - backing_since_s_ > config_.orbit.back_up_s ||
                       path_is_blocked(world.grid, {pose.position(), pose * Point(-behind_m, 0.0)}, 0.5 * behind_m,
                                       behind_m, world.robot.radius_m);
  if (!is_over) {
    context.drive({-config_.orbit.back_up_mps, 0.0});
    return {Progress::running, "backing off"};
  }
  mode_ = Mode::orbit;
  path_.take({});
  progress_.restart();
  return {Progress::running, "has backed off"};
}

Status Inspect::end_orbit(const Landmark& landmark, BehaviourContext& context) {
  wanted_ = {};
  path_.take({});
  if (covered_ < config_.orbit.min_covered_sectors) {
    if (orbits_ > 0) return finish(landmark, "it cannot be circled once more");
    return {Progress::failure, described(landmark) + " cannot be circled: no free path leads round it"};
  }
  ++orbits_;
  const double risen = landmark.degree - degree_at_lap_;
  char text[96];
  std::snprintf(text, sizeof text, "lap %d: degree %.3f -> %.3f", orbits_, degree_at_lap_, landmark.degree);
  context.say(std::string(text) + " of " + described(landmark));
  degree_at_lap_ = landmark.degree;
  orbit_begins_ = trace_.size();
  avoid_.clear();
  if (risen <= config_.gain) return finish(landmark, "it rises no more");
  if (orbits_ >= config_.rounds_at_most) return finish(landmark, "that was the last lap");
  return {Progress::running, "next lap"};
}

Status Inspect::finish(const Landmark& landmark, const std::string& why) const {
  char text[96];
  std::snprintf(text, sizeof text, "degree %.3f -> %.3f in %d %s", degree_before_, landmark.degree, orbits_,
                orbits_ == 1 ? "lap" : "laps");
  return {Progress::success, described(landmark) + ": " + text + ", " + why};
}

}  // namespace cairn::behaviours
