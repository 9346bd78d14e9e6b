#include "plugins/behaviours/errands/dock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "plugins/behaviours/errands/place_name.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kFarthestOutline_m = 1.2;
constexpr double kDockBehind_m = 0.2;                    // free for so long: the outline is behind
constexpr double kUsualOutline_m = 0.2;                  // of a landmark that the map does not show on that side
constexpr double kRunUps_m[] = {0.5, 0.35, 0.25, 0.15};  // from the standing place to the dock
constexpr double kStraight_rad = radians(20.0);          // a transducer that looks further aside does not look ahead
constexpr double kSame_rad = radians(1.0);
constexpr std::size_t kEchoes = 7;
constexpr std::size_t kMinEchoes = 3;
// Along the axis from the landmark's centre: what echoes nearer than this, or behind, is not the landmark.
constexpr double kPast_m = 0.05;
constexpr double kBefore_m = 0.25;  // an echo from so far before the mapped outline is of something else
constexpr double kBeside_m = 0.3;   // so far beside the axis is not before the side
constexpr int kMaxAgain = 3;
constexpr double kSettle_s = 1.0;  // stands for a full round of echoes before it believes that it is there
constexpr double kDockSlowest_mps = 0.02;
constexpr double kGain_per_s = 0.8;
constexpr double kTurnFirst_rad = radians(12.0);
constexpr double kMaxCorrection_rad = radians(20.0);
constexpr double kCorrection_rad_per_m = 2.5;
constexpr double kFaced_rad = radians(3.0);
constexpr double kRoomToTurn_m = 0.02;

const std::vector<std::string> kSides{"front", "left", "back", "right"};

// From the robot's centre to the end of its footprint, ahead or behind.
double extent_m(const RobotModel& robot, bool ahead) {
  if (robot.polygon_m.empty()) return robot.radius_m;
  double max_m = 0.0;
  for (const Point& p : robot.polygon_m) max_m = std::max(max_m, ahead ? p.x() : -p.x());
  return max_m;
}

bool is_free_about(const OccupancyGrid& grid, const Point& p, double radius_m) {
  const Cell middle = grid.cell_at(p);
  const int reach = static_cast<int>(radius_m / grid.cell_m());
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (dx * dx + dy * dy <= reach * reach && grid.state(middle + Cell{dx, dy}) != CellState::free) return false;
  return true;
}

std::string metres(double value_m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", value_m);
  return text;
}

}  // namespace

void DockConfig::describe(Fields<DockConfig>& fields) {
  using C = DockConfig;
  fields.raw("landmark", &C::landmark, "text", "a landmark's id (L3) or name, or `nearest CATEGORY`").required = true;
  fields.raw("side", &C::side, "choice", "of the landmark, in its own frame: front is its x axis; this or side_deg")
      .choices = kSides;
  fields.angle("side_deg", &C::side_rad, {-360.0, 360.0}, "the same as an angle, anticlockwise from its x axis");
  fields.number("distance_m", &C::distance_m, {0.02, 5.0}, "m", "between the robot's footprint and the landmark");
  fields.choice("facing", &C::facing, {{"landmark", C::Facing::landmark}, {"away", C::Facing::away}},
                "where the robot looks in the end");
  fields.number("tolerance_m", &C::dock_tolerance_m, {0.005, 1.0}, "m", "the distance may be so much more or less");
  fields.number("speed_mps", &C::speed_mps, {0.01, 5.0}, "m/s", "top speed to the standing place");
  fields.number("approach_mps", &C::approach_mps, {0.02, 1.0}, "m/s", "top speed from there on");
  fields.number("patience_s", &C::patience_s, {0.1, 3600.0}, "s", "waited for what is in the way to go");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "when it is up the step has failed");
}

std::optional<double> outline_distance_m(const OccupancyGrid& grid, const Point& centre, double angle_rad) {
  const Point direction(std::cos(angle_rad), std::sin(angle_rad));
  const double step_m = 0.5 * grid.cell_m();
  std::optional<double> last_m;
  for (double r_m = 0.0; r_m <= kFarthestOutline_m; r_m += step_m) {
    if (grid.state(grid.cell_at(centre + r_m * direction)) == CellState::occupied)
      last_m = r_m;
    else if (last_m && r_m - *last_m > kDockBehind_m)
      break;
  }
  return last_m;
}

Dock::Dock(const DockConfig& config, std::uint64_t seed)
    : config_(config),
      seed_(seed),
      name_(to_landmark_name(config.landmark, "landmark")),
      driver_(config, seed),
      watch_(config.patience_s) {
  const bool names_side = config.side.kind != ConfigValue::Kind::null;
  const SourcePlace& place = names_side ? config.side.place : config.landmark.place;
  if (names_side == config.side_rad.has_value())
    throw ConfigError(place, names_side ? "dock: side and side_deg exclude each other"
                                        : "dock: needs a side (`side: left` or `side_deg: 90`)");
  side_rad_ = names_side
                  ? std::numbers::pi / 2.0 * static_cast<double>(config_detail::to_choice(config.side, "side", kSides))
                  : *config.side_rad;
}

void Dock::halt() {
  *this = Dock(config_, seed_);
}

Point Dock::Axis::outward() const {
  return {std::cos(outward_rad), std::sin(outward_rad)};
}

double Dock::Axis::aside_m(const Point& p) const {
  return (p - centre).dot(Point(-std::sin(outward_rad), std::cos(outward_rad)));
}

Dock::Axis Dock::axis(const Landmark& landmark) const {
  return {landmark.T_map_landmark.position(), outward_rad_};
}

std::string Dock::where(const WorldView& world) const {
  char text[48];
  const bool names_side = config_.side.kind != ConfigValue::Kind::null;
  std::snprintf(text, sizeof text, "side at %.0f deg", degrees(side_rad_));
  const Landmark* landmark = world.graph.find(landmark_);
  return "the " + (names_side ? config_.side.scalar + " side" : std::string(text)) + " of " +
         (landmark == nullptr ? name_ : described(*landmark));
}

// From the outline to the robot's centre.
double Dock::wanted_m(const RobotModel& robot) const {
  return config_.distance_m + extent_m(robot, config_.facing == DockConfig::Facing::landmark);
}

Status Dock::tick(const WorldView& world, BehaviourContext& orders) {
  if (!begun_s_) begun_s_ = world.time_s;
  if (world.time_s - *begun_s_ >= config_.at_most_s)
    return {Progress::failure, "time is up on the way to " + where(world)};
  if (landmark_ == 0) return begin(world, orders);
  const Landmark* const landmark = world.graph.find(landmark_);
  if (landmark == nullptr) return {Progress::failure, lost(landmark_, world.graph)};
  switch (mode_) {
    case Mode::drive:
      return drive(world, orders);
    case Mode::approach:
      return approach(world, orders, *landmark);
    case Mode::turn:
      break;
  }
  return turn(world, orders, *landmark);
}

Status Dock::begin(const WorldView& world, BehaviourContext& orders) {
  const ChosenLandmark chosen = choose_landmark(name_, world, orders);
  if (!chosen.unknown.empty()) return {Progress::failure, chosen.unknown};
  landmark_ = chosen.id;
  if (config_.facing == DockConfig::Facing::away && wanted_m(world.robot) < world.robot.radius_m + kRoomToTurn_m)
    return {Progress::failure, "at " + metres(config_.distance_m) + " there is no room for the robot to turn away"};
  const Landmark& landmark = *world.graph.find(landmark_);
  outward_rad_ = landmark.T_map_landmark.theta_rad + side_rad_;
  if (!choose_stand(world, landmark))
    return {Progress::failure, where(world) + " is blocked: there is no free way to it on the map"};
  return {Progress::running, "going to " + where(world)};
}

// The longest run-up that nothing stands in; one from where the map knows of no room only when there is no other.
bool Dock::choose_stand(const WorldView& world, const Landmark& landmark) {
  const Axis line = axis(landmark);
  const double outline = outline_distance_m(world.grid, line.centre, line.outward_rad).value_or(kUsualOutline_m);
  const double margin_m = std::max(0.0, world.robot.radius_m - world.grid.cell_m());
  const double dock_m = outline + wanted_m(world.robot);
  const Point dock = line.centre + dock_m * line.outward();
  // The robot may come nearer to the outline than to anything else: only what stands aside or behind blocks.
  const double reach_m = std::min(margin_m, wanted_m(world.robot) - 0.02);
  for (const bool on_known_ground : {true, false}) {
    for (const double run_up_m : kRunUps_m) {
      const Point stand = line.centre + (dock_m + run_up_m) * line.outward();
      if (path_is_blocked(world.grid, {stand, dock}, 0.0, run_up_m, reach_m)) continue;
      if (on_known_ground && !is_free_about(world.grid, stand, world.robot.radius_m)) continue;
      stand_ = {};
      stand_.pose = Pose2{stand.x(), stand.y(), wrap_angle(line.outward_rad + std::numbers::pi)};
      stand_.heading_matters = true;
      return true;
    }
  }
  return false;
}

Status Dock::drive(const WorldView& world, BehaviourContext& orders) {
  const Status status = driver_.tick(stand_, world, orders);
  if (status.progress == Progress::running)
    return {Progress::running, status.reason + ", to " + where(world), status.left_s};
  if (status.progress == Progress::failure)
    return {Progress::failure, "cannot get to " + where(world) + ": " + status.reason};
  mode_ = Mode::approach;
  watch_.restart();
  return {Progress::running, "before " + where(world)};
}

// What has been seen meanwhile has moved the landmark on the map.
Status Dock::go_again(const WorldView& world, const Landmark& landmark) {
  if (++again_ > kMaxAgain || !choose_stand(world, landmark))
    return {Progress::failure, "cannot get before " + where(world) + ": the landmark moves on the map"};
  driver_.restart();
  echoes_m_.clear();
  mode_ = Mode::drive;
  return {Progress::running, "going to " + where(world) + " again"};
}

// Each echo of the transducers that look ahead, as a place on the axis. A range is to the nearest thing in the beam,
// and the distance that is wanted is to the nearest point of the landmark, too: no bearing is needed.
void Dock::see(const WorldView& world, const Axis& line, double mapped_m) {
  if (world.observation == nullptr) return;
  double straightest_rad = kStraight_rad;
  for (const SonarModel& sonar : world.robot.sonars)
    straightest_rad = std::min(straightest_rad, std::abs(sonar.T_robot_sonar.theta_rad));
  const double robot_m = line.along_m(world.pose.T_map_robot.position());
  for (const RangeReading& reading : world.observation->ranges) {
    if (!(std::abs(reading.T_robot_sensor.theta_rad) <= straightest_rad + kSame_rad)) continue;
    const double echo_m = robot_m - (reading.T_robot_sensor.x_m + reading.range_m);
    if (std::isnan(echo_m)) continue;
    if (echo_m > mapped_m + kBefore_m) {
      if (between_since_s_ >= 0.0) continue;
      between_since_s_ = world.time_s;
      between_sensor_ = reading.sensor;
      continue;
    }
    if (reading.sensor == between_sensor_) between_since_s_ = -1.0;
    if (echo_m < kPast_m) continue;  // or no echo
    echoes_m_.push_back(echo_m);
    if (echoes_m_.size() > kEchoes) echoes_m_.pop_front();
  }
}

double Dock::outline_m(double mapped_m) const {
  if (echoes_m_.size() < kMinEchoes) return mapped_m;
  std::vector<double> sorted(echoes_m_.begin(), echoes_m_.end());
  std::ranges::sort(sorted);
  return sorted[sorted.size() / 2];
}

Status Dock::approach(const WorldView& world, BehaviourContext& orders, const Landmark& landmark) {
  const Axis line = axis(landmark);
  const Pose2& pose = world.pose.T_map_robot;
  const double mapped_m = outline_distance_m(world.grid, line.centre, line.outward_rad).value_or(kUsualOutline_m);
  if (std::abs(line.aside_m(pose.position())) > kBeside_m) return go_again(world, landmark);
  see(world, line, mapped_m);
  if (between_since_s_ >= 0.0) {
    wanted_ = {};
    watch_.restart();  // waiting is not being held back
    if (world.time_s - between_since_s_ > config_.patience_s)
      return {Progress::failure, "something stands between the robot and " + where(world)};
    return {Progress::running, "waiting: something is before " + where(world)};
  }
  if (watch_.is_stuck(world, wanted_))
    return {Progress::failure,
            "held back " + metres(gap_m_) + " before " + where(world) + ", not at " + metres(config_.distance_m)};
  const double left_m = line.along_m(pose.position()) - outline_m(mapped_m) - wanted_m(world.robot);
  gap_m_ = left_m + config_.distance_m;
  const double correction_rad =
      std::clamp(kCorrection_rad_per_m * line.aside_m(pose.position()), -kMaxCorrection_rad, kMaxCorrection_rad);
  // Looking inward, who stands to the left of the axis (seen outward) has it on the left.
  const bool is_there = std::abs(left_m) <= 0.5 * config_.dock_tolerance_m;
  const double heading_rad = line.outward_rad + std::numbers::pi + (left_m > 0.1 ? correction_rad : 0.0);
  const double error_rad = wrap_angle(heading_rad - pose.theta_rad);
  wanted_ = {};
  if (is_there && std::abs(error_rad) <= kFaced_rad) {
    if (still_since_s_ < 0.0) still_since_s_ = world.time_s;
    if (world.time_s - still_since_s_ < kSettle_s) return {Progress::running, "looking once more at " + where(world)};
    mode_ = Mode::turn;
    return turn(world, orders, landmark);
  }
  still_since_s_ = -1.0;
  const double max_mps = std::min(config_.approach_mps, world.robot.max_v_mps);
  const double max_radps = std::min(radians(40.0), world.robot.max_w_radps);
  const double v_mps = std::clamp(std::abs(left_m) * kGain_per_s, std::min(kDockSlowest_mps, max_mps), max_mps);
  if (!is_there && std::abs(error_rad) <= kTurnFirst_rad) wanted_.v_mps = left_m > 0.0 ? v_mps : -v_mps;
  wanted_.w_radps = std::clamp(1.5 * error_rad, -max_radps, max_radps);
  orders.drive(wanted_);
  return {Progress::running, metres(gap_m_) + " before " + where(world)};
}

Status Dock::turn(const WorldView& world, BehaviourContext& orders, const Landmark& landmark) {
  const double final_rad =
      axis(landmark).outward_rad + (config_.facing == DockConfig::Facing::away ? 0.0 : std::numbers::pi);
  const double error_rad = wrap_angle(final_rad - world.pose.T_map_robot.theta_rad);
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  if (can_turn && std::abs(error_rad) > kFaced_rad) {
    orders.drive(turn_by(error_rad, std::min(radians(45.0), world.robot.max_w_radps)));
    return {Progress::running, "turning at " + where(world)};
  }
  return {Progress::success, "docked at " + where(world) + ", " + metres(gap_m_) + " from it by " +
                                 (echoes_m_.size() < kMinEchoes ? "the map" : "its echoes")};
}

}  // namespace cairn::behaviours
