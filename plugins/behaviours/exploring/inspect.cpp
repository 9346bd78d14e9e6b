#include "plugins/behaviours/exploring/inspect.hpp"

#include <algorithm>
#include <cstdio>

#include "plugins/behaviours/errands/place_name.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kNearOrbit_m = 1.5;  // from here on the laps' own paths lead on
constexpr double kSpace_m = 3.0;
constexpr double kClearance_m = 0.08;
constexpr double kLookCloser_m = 0.3;  // a lap may lead further from the landmark by this
constexpr double kLargestObject_m = 1.5;
constexpr int kUsualOutline_cells = 3;  // of a landmark that the map does not show
constexpr double kApproachChoiceEvery_s = 2.5;
constexpr int kMinCovered = 4;  // sectors: less is no lap
constexpr double kInspectBackOff_mps = 0.1;
constexpr double kBackOff_s = 1.5;
constexpr double kAheadOfStop_m = 0.4;

CellGroup object_at(const FreeSpace& space, const Point& centre) {
  CellGroup best;
  double nearest_m = kIsLandmark_m;
  for (CellGroup& object : compact_objects(space, kLargestObject_m)) {
    Point sum{0.0, 0.0};
    for (const Cell c : object) sum += space.centre_of(c);
    const double distance_m = (sum / static_cast<double>(object.size()) - centre).norm();
    if (distance_m > nearest_m) continue;
    nearest_m = distance_m;
    best = std::move(object);
  }
  if (!best.empty()) return best;
  const Cell middle = space.cell_at(centre);
  for (int dy = -kUsualOutline_cells; dy <= kUsualOutline_cells; ++dy)
    for (int dx = -kUsualOutline_cells; dx <= kUsualOutline_cells; ++dx) best.push_back(middle + Cell{dx, dy});
  return best;
}

}  // namespace

void InspectConfig::describe(Fields<InspectConfig>& fields) {
  using C = InspectConfig;
  fields.raw("landmark", &C::landmark, "text", "a landmark's id (L3) or name, or `nearest CATEGORY`").required = true;
  fields.number("distance_m", &C::distance_m, {0.1, 5.0}, "m", "from its edge to the robot's centre on a lap");
  fields.integer("rounds_at_most", &C::rounds_at_most, {1.0, 100.0}, "laps, whatever the degree does");
  fields.number("gain", &C::gain, {0.0, 1.0}, "", "no lap more when the degree has not risen by more than this in one");
  fields.number("orbit_speed_mps", &C::orbit_speed_mps, {0.01, 5.0}, "m/s", "top speed on a lap");
  fields.number("speed_mps", &C::speed_mps, {0.01, 5.0}, "m/s", "top speed on the way there");
  fields.number("patience_s", &C::patience_s, {0.1, 3600.0}, "s", "waited for what is in the way to go");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "when it is up, it ends with what it has seen");
  fields.shorthand("landmark");
}

Inspect::Inspect(const InspectConfig& config, std::uint64_t seed)
    : config_(config),
      seed_(seed),
      name_(to_landmark_name(config.landmark, "landmark")),
      driver_(config, seed),
      watch_(config.patience_s) {}

void Inspect::halt() {
  *this = Inspect(config_, seed_);
}

Status Inspect::tick(const WorldView& world, BehaviourContext& orders) {
  if (!begun_s_) begun_s_ = world.time_s;
  if (landmark_ == 0) return begin(world, orders);
  const Landmark* const landmark = world.graph.find(landmark_);
  if (landmark == nullptr) return {Progress::failure, lost(landmark_, world.graph)};
  remember(world);
  if (world.time_s - *begun_s_ >= config_.at_most_s) {
    if (orbits_ > 0) return finish(*landmark, "time is up");
    return {Progress::failure, "time is up before a lap round " + described(*landmark) + " was done"};
  }
  switch (mode_) {
    case Mode::drive:
      return drive(world, orders, *landmark);
    case Mode::orbit:
      return orbit(world, orders, *landmark);
    case Mode::back_off:
      break;
  }
  return back_off(world, orders);
}

void Inspect::remember(const WorldView& world) {
  const Pose2& pose = world.pose.T_map_robot;
  if (!near_echoes_) near_echoes_.emplace(world.grid);
  if (world.observation != nullptr) near_echoes_->see(*world.observation, pose);
  near_echoes_->stand_at(pose.position(), world.robot.radius_m);
  if (trace_.empty() || (trace_.back().position() - pose.position()).norm() >= kTraceSpacing_m) trace_.push_back(pose);
}

Status Inspect::begin(const WorldView& world, BehaviourContext& orders) {
  const ChosenLandmark chosen = choose_landmark(name_, world, orders);
  if (!chosen.unknown.empty()) return {Progress::failure, chosen.unknown};
  landmark_ = chosen.id;
  degree_before_ = degree_at_lap_ = world.graph.find(landmark_)->degree;
  return {Progress::running, "going to " + described(*world.graph.find(landmark_))};
}

Status Inspect::drive(const WorldView& world, BehaviourContext& orders, const Landmark& landmark) {
  const bool is_near =
      (landmark.T_map_landmark.position() - world.pose.T_map_robot.position()).norm() <= kNearOrbit_m &&
      choose_way(world, landmark);
  Status status{Progress::success, ""};
  if (!is_near) {
    Place goal;
    goal.landmarks = {landmark_};
    status = driver_.tick(goal, world, orders);
  }
  if (status.progress == Progress::running)
    return {Progress::running, status.reason + ", to " + described(landmark), status.left_s};
  if (status.progress == Progress::failure)
    return {Progress::failure, "cannot get to " + described(landmark) + ": " + status.reason};
  mode_ = Mode::orbit;
  orbit_begins_ = trace_.size();
  watch_.restart();
  return {Progress::running, "at " + described(landmark)};
}

bool Inspect::choose_way(const WorldView& world, const Landmark& landmark) {
  chosen_s_ = world.time_s;
  const Pose2& pose = world.pose.T_map_robot;
  const Point centre = landmark.T_map_landmark.position();
  const Cell here = world.grid.cell_at(pose.position());
  const Cell there = world.grid.cell_at(centre);
  const int reach = static_cast<int>(kSpace_m / world.grid.cell_m());
  const CellBox part = united(CellBox{here, here + Cell{1, 1}}, CellBox{there, there + Cell{1, 1}}).grown(reach);
  const FreeSpace space(near_echoes_->applied_to(world.grid, part),
                        {pose.position(), world.robot.radius_m, kClearance_m}, trace_);
  const OrbitSettings settings{config_.distance_m, config_.distance_m + kLookCloser_m, kLargestObject_m};
  const auto of_orbit = std::span(trace_).subspan(std::min(orbit_begins_, trace_.size()));
  const Orbit round = orbit_round(space, object_at(space, centre), of_orbit, avoid_, settings);
  covered_ = round.count(SectorState::covered);
  if (round.count(SectorState::open) == 0) return false;
  path_ = orbit_route(space, round, pose).path;
  follow_state_ = {0.0, follow_state_.turning};
  return !path_.empty();
}

Status Inspect::orbit(const WorldView& world, BehaviourContext& orders, const Landmark& landmark) {
  const Pose2& pose = world.pose.T_map_robot;
  if (watch_.is_stuck(world, wanted_)) {
    avoid_.push_back(pose * Point(kAheadOfStop_m, 0.0));
    mode_ = Mode::back_off;
    backing_since_s_ = world.time_s;
    wanted_ = {};
    return back_off(world, orders);
  }
  FollowLimits limits = follow_limits(world.robot, config_.orbit_speed_mps);
  FollowStep step = follow(pose, path_, follow_state_, limits);
  if (path_.empty() || step.arrived || world.time_s - chosen_s_ >= kApproachChoiceEvery_s) {
    const bool was_there = step.arrived && !path_.empty();
    const Point end = was_there ? path_.back() : Point(1e9, 1e9);
    if (!choose_way(world, landmark)) return end_orbit(landmark, orders);
    // Arrived, and the sector still counts as open: it cannot be seen from there.
    if (was_there && (path_.back() - end).norm() < kTraceSpacing_m) avoid_.push_back(end);
    step = follow(pose, path_, follow_state_, limits);
  }
  follow_state_ = step.state;
  wanted_ = step.wanted;
  orders.drive(wanted_);
  return {Progress::running, "going round " + described(landmark) + ", lap " + std::to_string(orbits_ + 1)};
}

Status Inspect::back_off(const WorldView& world, BehaviourContext& orders) {
  const bool is_over =
      world.time_s - backing_since_s_ > kBackOff_s ||
      path_is_blocked(world.grid, {world.pose.T_map_robot.position(), world.pose.T_map_robot * Point(-0.2, 0.0)}, 0.1,
                      0.2, world.robot.radius_m);
  if (!is_over) {
    orders.drive({-kInspectBackOff_mps, 0.0});
    return {Progress::running, "backing off"};
  }
  mode_ = Mode::orbit;
  path_.clear();
  watch_.restart();
  return {Progress::running, "has backed off"};
}

Status Inspect::end_orbit(const Landmark& landmark, BehaviourContext& orders) {
  wanted_ = {};
  path_.clear();
  if (covered_ < kMinCovered) {
    if (orbits_ > 0) return finish(landmark, "it cannot be circled once more");
    return {Progress::failure, described(landmark) + " cannot be circled: no free way leads round it"};
  }
  ++orbits_;
  const double risen = landmark.degree - degree_at_lap_;
  char text[96];
  std::snprintf(text, sizeof text, "lap %d: degree %.3f -> %.3f", orbits_, degree_at_lap_, landmark.degree);
  orders.say(std::string(text) + " of " + described(landmark));
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
