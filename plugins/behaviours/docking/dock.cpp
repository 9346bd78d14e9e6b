#include "plugins/behaviours/docking/dock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "plugins/behaviours/places/place_name.hpp"
#include "plugins/common/motion/velocity.hpp"

namespace cairn::behaviours {
namespace {

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

void OutlineSettings::describe(Fields<OutlineSettings>& fields) {
  using C = OutlineSettings;
  fields.number("farthest_m", &C::farthest_m, {0.05, 20.0}, "m", "the outline is looked for this far from the centre");
  fields.number("behind_m", &C::behind_m, {0.01, 10.0}, "m", "where it is free for so long the outline is behind");
  fields.number("usual_m", &C::usual_m, {0.0, 10.0}, "m", "of a landmark that the map does not show on that side");
}

void ApproachSettings::describe(Fields<ApproachSettings>& fields) {
  using C = ApproachSettings;
  fields.angle("straight_deg", &C::straight_rad, {0.0, 90.0}, "transducers that look further aside do not count");
  fields.angle("same_deg", &C::same_rad, {0.0, 45.0}, "those that look as straight ahead, give or take this, do");
  fields.integer<int>("echoes", &C::echoes, {1.0, 1000.0}, "the distance is the median of so many last echoes");
  fields.integer<int>("min_echoes", &C::min_echoes, {1.0, 1000.0}, "with fewer it is taken from the map");
  fields.number("past_m", &C::past_m, {0.0, 5.0}, "m",
                "echoes from nearer than this to the landmark's centre, or behind it, are not of the landmark");
  fields.number("before_m", &C::before_m, {0.0, 5.0}, "m",
                "an echo from so far before the outline on the map is of something else");
  fields.number("beside_m", &C::beside_m, {0.0, 5.0}, "m", "so far beside the axis the robot is not before the side");
  fields.integer("max_again", &C::max_again, {0.0, 100.0}, "how often the approach begins again");
  fields.number("settle_s", &C::settle_s, {0.0, 600.0}, "s", "it stands for a round of echoes before it has arrived");
  fields.number("min_mps", &C::min_mps, {0.001, 1.0}, "m/s", "slowest approach");
  fields.number("gain_per_s", &C::gain_per_s, {0.01, 20.0}, "1/s", "speed for each metre that is left");
  fields.angle("turn_first_deg", &C::turn_first_rad, {0.1, 90.0}, "with a larger heading error it turns first");
  fields.angle("max_correction_deg", &C::max_correction_rad, {0.0, 90.0},
               "largest heading with which it comes back to the axis");
  fields.number("correction_rad_per_m", &C::correction_rad_per_m, {0.0, 100.0}, "rad/m",
                "that heading for each metre beside the axis");
  fields.number("correct_until_m", &C::correct_until_m, {0.0, 5.0}, "m", "nearer than this it goes straight");
  fields.angle("faced_deg", &C::faced_rad, {0.1, 90.0}, "a heading error within this is faced");
  fields.number("turn_gain_per_s", &C::turn_gain_per_s, {0.01, 20.0}, "1/s", "turn rate for each radian of error");
  fields.angle("max_turn_degps", &C::max_turn_radps, {1.0, 360.0}, "fastest turn on the approach", "deg/s");
  fields.angle("final_turn_degps", &C::final_turn_radps, {1.0, 360.0}, "fastest turn at its end", "deg/s");
  fields.number("room_to_turn_m", &C::room_to_turn_m, {0.0, 5.0}, "m", "room beside the robot to turn away");
  fields.number("nearest_m", &C::nearest_m, {0.0, 5.0}, "m",
                "what stands nearer to the dock than the landmark's outline by this blocks the side");
  fields.number("arrived_ratio", &C::arrived_ratio, {0.0, 1.0}, "",
                "the approach has arrived within this share of tolerance_m");
}

void DockConfig::describe(Fields<DockConfig>& fields) {
  using C = DockConfig;
  fields.raw("landmark", &C::landmark, "text", "a landmark's id (L3) or name, a category, or `nearest CATEGORY`")
      .required = true;
  fields.raw("side", &C::side, "choice", "of the landmark, in its own frame: front is its x axis; this or side_deg")
      .choices = kSides;
  fields.angle("side_deg", &C::side_rad, {-360.0, 360.0}, "the same as an angle, anticlockwise from its x axis");
  fields.number("distance_m", &C::distance_m, {0.02, 5.0}, "m", "between the robot's footprint and the landmark");
  fields.choice("facing", &C::facing, {{"landmark", C::Facing::landmark}, {"away", C::Facing::away}},
                "where the robot looks in the end");
  fields.number("tolerance_m", &C::dock_tolerance_m, {0.005, 1.0}, "m", "the distance may be so much more or less");
  fields.number("speed_mps", &C::speed_mps, {0.01, 5.0}, "m/s", "top speed to the approach pose");
  fields.number("approach_mps", &C::approach_mps, {0.02, 1.0}, "m/s", "top speed from there on");
  fields.number("patience_s", &C::patience_s, {0.1, 3600.0}, "s", "how long it waits for a blockage to go");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e6}, "s", "when it is up the step has failed");
  fields.numbers("run_ups_m", &C::run_ups_m, {0.0, 10.0}, "m",
                 "lengths of the straight approach to try, one after the other; [0.5, 0.35, 0.25, 0.15] unless given");
  fields.group("outline", &C::outline, "the landmark's outline on the map");
  fields.group("approach", &C::approach, "the straight approach");
  describe_driving(fields);
}

std::optional<double> outline_distance_m(const OccupancyGrid& grid, const Point& centre, double angle_rad,
                                         const OutlineSettings& settings) {
  const Point direction(std::cos(angle_rad), std::sin(angle_rad));
  const double step_m = 0.5 * grid.cell_m();
  std::optional<double> last_m;
  for (double r_m = 0.0; r_m <= settings.farthest_m; r_m += step_m) {
    if (grid.state(grid.cell_at(centre + r_m * direction)) == CellState::occupied)
      last_m = r_m;
    else if (last_m && r_m - *last_m > settings.behind_m)
      break;
  }
  return last_m;
}

Dock::Dock(const DockConfig& config, std::uint64_t seed)
    : config_(config),
      seed_(seed),
      name_(to_landmark_name(config.landmark, "landmark")),
      driver_(config, seed),
      progress_(config.patience_s, config.driving.progress),
      echoes_(config.approach) {
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

DockAxis Dock::axis(const Landmark& landmark) const {
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

Status Dock::tick(const WorldView& world, BehaviourContext& context) {
  if (!begun_s_) begun_s_ = world.time_s;
  if (world.time_s - *begun_s_ >= config_.at_most_s)
    return {StepState::failure, "time is up on the way to " + where(world)};
  if (const auto exchange = map_watch_.update(world)) begin_in_new_map(exchange->move);
  if (landmark_ == 0) return begin(world, context);
  const Landmark* const landmark = world.graph.find(landmark_);
  if (landmark == nullptr) return {StepState::failure, lost(landmark_, world.graph)};
  switch (mode_) {
    case Mode::drive:
      return drive(world, context);
    case Mode::approach:
      return approach(world, context, *landmark);
    case Mode::turn:
      break;
  }
  return turn(world, context, *landmark);
}

// The landmark has its place in the new one; the side of it that was meant turns as the map does there.
void Dock::begin_in_new_map(const MapMove* move) {
  if (landmark_ == 0) return;
  if (move == nullptr) {
    landmark_ = 0;  // chosen anew
    mode_ = Mode::drive;
    driver_.restart();
    echoes_.forget();
    return;
  }
  if (!approach_pose_.pose) return;
  const Pose2 T = move->near(approach_pose_.pose->position());
  approach_pose_.pose = T * *approach_pose_.pose;
  outward_rad_ = wrap_angle(outward_rad_ + T.theta_rad);
}

Status Dock::begin(const WorldView& world, BehaviourContext& context) {
  const ChosenLandmark chosen = choose_landmark(name_, world, context);
  if (!chosen.unknown.empty()) return {StepState::failure, chosen.unknown};
  landmark_ = chosen.id;
  if (config_.facing == DockConfig::Facing::away &&
      wanted_m(world.robot) < world.robot.radius_m + config_.approach.room_to_turn_m)
    return {StepState::failure, "at " + metres(config_.distance_m) + " there is no room for the robot to turn away"};
  const Landmark& landmark = *world.graph.find(landmark_);
  outward_rad_ = landmark.T_map_landmark.theta_rad + side_rad_;
  if (!choose_approach_pose(world, landmark))
    return {StepState::failure, where(world) + " is blocked: there is no free path to it on the map"};
  return {StepState::running, "going to " + where(world)};
}

// The longest run-up that nothing stands in; one from where the map knows of no room only when there is no other.
bool Dock::choose_approach_pose(const WorldView& world, const Landmark& landmark) {
  const DockAxis line = axis(landmark);
  const double margin_m = std::max(0.0, world.robot.radius_m - world.grid.cell_m());
  const double dock_m = mapped_outline_m(world.grid, line) + wanted_m(world.robot);
  const Point dock = line.centre + dock_m * line.outward();
  // The robot may come nearer to the outline than to anything else: only what stands aside or behind blocks.
  const double reach_m = std::min(margin_m, wanted_m(world.robot) - config_.approach.nearest_m);
  for (const bool on_known_ground : {true, false}) {
    for (const double run_up_m : config_.run_ups_m) {
      const Point stand = line.centre + (dock_m + run_up_m) * line.outward();
      if (path_is_blocked(world.grid, {stand, dock}, 0.0, run_up_m, reach_m)) continue;
      if (on_known_ground && !is_free_about(world.grid, stand, world.robot.radius_m)) continue;
      approach_pose_ = {};
      approach_pose_.pose = Pose2{stand.x(), stand.y(), wrap_angle(line.outward_rad + std::numbers::pi)};
      approach_pose_.heading_matters = true;
      return true;
    }
  }
  return false;
}

Status Dock::drive(const WorldView& world, BehaviourContext& context) {
  const Status status = driver_.tick(approach_pose_, world, context);
  if (status.state == StepState::running)
    return {StepState::running, status.reason + ", to " + where(world), status.left_s};
  if (status.state == StepState::failure)
    return {StepState::failure, "cannot get to " + where(world) + ": " + status.reason};
  mode_ = Mode::approach;
  progress_.restart();
  return {StepState::running, "before " + where(world)};
}

// What has been seen meanwhile has moved the landmark on the map.
Status Dock::go_again(const WorldView& world, const Landmark& landmark) {
  if (++again_ > config_.approach.max_again || !choose_approach_pose(world, landmark))
    return {StepState::failure, "cannot get before " + where(world) + ": the landmark moves on the map"};
  driver_.restart();
  echoes_.forget();
  mode_ = Mode::drive;
  return {StepState::running, "going to " + where(world) + " again"};
}

double Dock::mapped_outline_m(const OccupancyGrid& grid, const DockAxis& line) const {
  return outline_distance_m(grid, line.centre, line.outward_rad, config_.outline).value_or(config_.outline.usual_m);
}

Status Dock::approach(const WorldView& world, BehaviourContext& context, const Landmark& landmark) {
  const DockAxis line = axis(landmark);
  const Pose2& pose = world.pose.T_map_robot;
  const double mapped_m = mapped_outline_m(world.grid, line);
  if (std::abs(line.aside_m(pose.position())) > config_.approach.beside_m) return go_again(world, landmark);
  echoes_.see(world, line, mapped_m);
  if (echoes_.between_since_s()) {
    wanted_ = {};
    progress_.restart();  // waiting is not being blocked
    if (world.time_s - *echoes_.between_since_s() > config_.patience_s)
      return {StepState::failure, "something stands between the robot and " + where(world)};
    return {StepState::running, "waiting: something is before " + where(world)};
  }
  if (progress_.is_stuck(world, wanted_))
    return {StepState::failure,
            "blocked " + metres(gap_m_) + " before " + where(world) + ", not at " + metres(config_.distance_m)};
  const double left_m = line.along_m(pose.position()) - echoes_.outline_m().value_or(mapped_m) - wanted_m(world.robot);
  gap_m_ = left_m + config_.distance_m;
  const double correction_rad = std::clamp(config_.approach.correction_rad_per_m * line.aside_m(pose.position()),
                                           -config_.approach.max_correction_rad, config_.approach.max_correction_rad);
  // Looking inward, who stands to the left of the axis (seen outward) has it on the left.
  const bool is_there = std::abs(left_m) <= config_.approach.arrived_ratio * config_.dock_tolerance_m;
  const double heading_rad =
      line.outward_rad + std::numbers::pi + (left_m > config_.approach.correct_until_m ? correction_rad : 0.0);
  const double error_rad = wrap_angle(heading_rad - pose.theta_rad);
  wanted_ = {};
  if (is_there && std::abs(error_rad) <= config_.approach.faced_rad) {
    if (!still_since_s_) still_since_s_ = world.time_s;
    if (world.time_s - *still_since_s_ < config_.approach.settle_s)
      return {StepState::running, "looking once more at " + where(world)};
    mode_ = Mode::turn;
    return turn(world, context, landmark);
  }
  still_since_s_.reset();
  wanted_ = twist_towards(is_there ? 0.0 : left_m, error_rad, world.robot);
  context.drive(wanted_);
  return {StepState::running, metres(gap_m_) + " before " + where(world)};
}

// Along the axis once it is faced, the slower the nearer. left_m 0: on the spot.
Twist Dock::twist_towards(double left_m, double error_rad, const RobotModel& robot) const {
  const ApproachSettings& approach = config_.approach;
  const double max_mps = std::min(config_.approach_mps, robot.max_v_mps);
  const double max_radps = std::min(approach.max_turn_radps, robot.max_w_radps);
  const double v_mps = std::clamp(std::abs(left_m) * approach.gain_per_s, std::min(approach.min_mps, max_mps), max_mps);
  Twist twist;
  if (left_m != 0.0 && std::abs(error_rad) <= approach.turn_first_rad) twist.v_mps = left_m > 0.0 ? v_mps : -v_mps;
  twist.w_radps = std::clamp(approach.turn_gain_per_s * error_rad, -max_radps, max_radps);
  return twist;
}

Status Dock::turn(const WorldView& world, BehaviourContext& context, const Landmark& landmark) {
  const double final_rad =
      axis(landmark).outward_rad + (config_.facing == DockConfig::Facing::away ? 0.0 : std::numbers::pi);
  const double error_rad = wrap_angle(final_rad - world.pose.T_map_robot.theta_rad);
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  if (can_turn && std::abs(error_rad) > config_.approach.faced_rad) {
    context.drive(motion::turn_by(error_rad, std::min(config_.approach.final_turn_radps, world.robot.max_w_radps),
                                  config_.driving.turn));
    return {StepState::running, "turning at " + where(world)};
  }
  return {StepState::success, "docked at " + where(world) + ", " + metres(gap_m_) + " from it by " +
                                  (echoes_.outline_m() ? "its echoes" : "the map")};
}

}  // namespace cairn::behaviours
