#include "framework/planning/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

namespace cairn {
namespace {

constexpr double kMinStep_m = 1e-9;
constexpr double kMinTurn_rad = 1e-9;
constexpr double kMinPart_ratio = 1e-6;             // of a leg, to be a part of its own
constexpr double kOffTrack_m = 0.005;               // how far an arc may miss the next pose
constexpr double kMaxOffChord_rad = radians(45.0);  // of an arc's ends

// Chord by arc, of an arc that turns by so much.
double chord_ratio(double turn_rad) {
  const double half_rad = 0.5 * std::abs(turn_rad);
  return half_rad < kMinTurn_rad ? 1.0 : std::sin(half_rad) / half_rad;
}

// From one point of the path to the next.
struct Leg {
  Point from;
  Point chord;
  double length_m = 0.0;     // as driven
  double heading_rad = 0.0;  // where it begins
  double turn_rad = 0.0;     // between the poses
  bool backwards = false;
  bool is_arc = false;  // else it is driven straight

  [[nodiscard]] Pose2 at(double share) const {
    Point gone = share * chord;
    if (is_arc)
      gone = Pose2{0.0, 0.0, 0.5 * (share - 1.0) * turn_rad} * gone *
             (chord_ratio(share * turn_rad) / chord_ratio(turn_rad));
    return {from.x() + gone.x(), from.y() + gone.y(), wrap_angle(heading_rad + share * turn_rad)};
  }

  [[nodiscard]] double curvature() const { return turn_rad / length_m; }
  [[nodiscard]] double last_heading_rad() const { return heading_rad + turn_rad; }
};

Leg leg_between(const Pose2& from, const Pose2& to, bool turns_on_the_spot) {
  Leg leg{from.position(), to.position() - from.position()};
  leg.length_m = leg.chord.norm();
  double along_rad = std::atan2(leg.chord.y(), leg.chord.x());
  leg.backwards = std::cos(along_rad - from.theta_rad) < 0.0;
  if (leg.backwards) along_rad += std::numbers::pi;
  const double before_rad = wrap_angle(along_rad - from.theta_rad);
  const double after_rad = wrap_angle(to.theta_rad - along_rad);
  leg.is_arc = std::max(std::abs(before_rad), std::abs(after_rad)) <= kMaxOffChord_rad &&
               0.25 * leg.length_m * std::abs(before_rad - after_rad) <= kOffTrack_m;
  leg.heading_rad = along_rad;
  if (leg.is_arc || !turns_on_the_spot) {
    leg.heading_rad = from.theta_rad;
    leg.turn_rad = before_rad + after_rad;
  }
  if (leg.is_arc) leg.length_m /= chord_ratio(leg.turn_rad);
  return leg;
}

class TimedDrive {
 public:
  explicit TimedDrive(const RobotModel& robot) : robot_(robot) {}

  void begin(const Pose2& pose) { points_.push_back({0.0, pose, 0.0, 0.0}); }

  void turn_to(double heading_rad) {
    const Pose2 from = points_.back().pose;
    const double turn_rad = wrap_angle(heading_rad - from.theta_rad);
    const double way_rad = std::abs(turn_rad);
    if (way_rad < kMinTurn_rad) return;
    const double alpha = robot_.max_turn_acceleration_radps2;
    const double w = std::min(robot_.max_w_radps, std::sqrt(alpha * way_rad));
    const double ramp_rad = 0.5 * w * w / alpha;
    const auto add = [&](double time_s, double at_rad, double w_radps) {
      const double theta_rad = wrap_angle(from.theta_rad + std::copysign(at_rad, turn_rad));
      add_point(time_s, {from.x_m, from.y_m, theta_rad}, 0.0, std::copysign(w_radps, turn_rad));
    };
    add(w / alpha, ramp_rad, w);
    if (way_rad - 2.0 * ramp_rad > kMinTurn_rad) add((way_rad - 2.0 * ramp_rad) / w, way_rad - ramp_rad, w);
    add(w / alpha, way_rad, 0.0);
  }

  // Legs in one go, at rest before and after: as fast as each point allows for itself, then no faster than can be
  // reached from before and braked to behind.
  void drive(std::span<const Leg> legs) {
    const std::size_t n = legs.size();
    std::vector<double> curvature(n + 1, 0.0);
    curvature[0] = legs.front().curvature();
    curvature[n] = legs.back().curvature();
    for (std::size_t i = 1; i < n; ++i) curvature[i] = 0.5 * (legs[i - 1].curvature() + legs[i].curvature());
    std::vector<Limits> limits;
    for (std::size_t i = 0; i < n; ++i) limits.push_back(limits_of(legs[i].length_m, curvature[i], curvature[i + 1]));
    std::vector<double> v2(n + 1, 0.0);
    for (std::size_t i = 1; i < n; ++i)
      v2[i] = std::min({limits[i - 1].v * limits[i - 1].v, limits[i].v * limits[i].v,
                        v2[i - 1] + 2.0 * limits[i - 1].a * legs[i - 1].length_m});
    for (std::size_t i = n; i-- > 1;) v2[i] = std::min(v2[i], v2[i + 1] + 2.0 * limits[i].a * legs[i].length_m);
    for (std::size_t i = 0; i < n; ++i) add_leg(legs[i], limits[i], v2[i], v2[i + 1], curvature[i], curvature[i + 1]);
  }

  [[nodiscard]] std::vector<TrajectoryPoint> points() && { return std::move(points_); }

 private:
  struct Limits {
    double v = 0.0;
    double a = 0.0;
  };

  // With w = curvature * v, its acceleration on a leg is curvature * a + (change of curvature per metre) * v^2: at most
  // half of what the robot can is left to the second.
  [[nodiscard]] Limits limits_of(double length_m, double curvature_a, double curvature_b) const {
    const double most = std::max(std::abs(curvature_a), std::abs(curvature_b));
    const double change = std::abs(curvature_b - curvature_a) / length_m;
    const double alpha = robot_.max_turn_acceleration_radps2;
    Limits limits{robot_.max_v_mps, robot_.max_acceleration_mps2};
    if (most > 0.0) limits.v = std::min(limits.v, robot_.max_w_radps / most);
    if (change > 0.0) limits.v = std::min(limits.v, std::sqrt(0.5 * alpha / change));
    if (most > 0.0) limits.a = std::min(limits.a, (alpha - change * limits.v * limits.v) / most);
    return limits;
  }

  // Faster in between, where there is room for it.
  void add_leg(const Leg& leg, const Limits& limits, double v2_from, double v2_to, double curvature_a,
               double curvature_b) {
    const double peak2 = std::min(limits.v * limits.v, 0.5 * (v2_from + v2_to) + limits.a * leg.length_m);
    const double rise_m = (peak2 - v2_from) / (2.0 * limits.a);
    const double fall_m = (peak2 - v2_to) / (2.0 * limits.a);
    double s_m = 0.0;
    double v = std::sqrt(v2_from);
    const auto add = [&](double to_m, double v_to) {
      const double share = to_m / leg.length_m;
      const double curvature = curvature_a + share * (curvature_b - curvature_a);
      add_point(2.0 * (to_m - s_m) / (v + v_to), leg.at(share), leg.backwards ? -v_to : v_to, curvature * v_to);
      s_m = to_m;
      v = v_to;
    };
    const double min_m = kMinPart_ratio * leg.length_m;
    // However short, what brings it from rest is not left out: nothing else does.
    if ((rise_m > min_m || v2_from <= 0.0) && leg.length_m - rise_m > min_m) add(rise_m, std::sqrt(peak2));
    if (fall_m > min_m && leg.length_m - fall_m - s_m > min_m) add(leg.length_m - fall_m, std::sqrt(peak2));
    add(leg.length_m, std::sqrt(v2_to));
  }

  void add_point(double after_s, const Pose2& pose, double v, double w) {
    points_.push_back({points_.back().time_s + after_s, pose, v, w});
  }

  const RobotModel& robot_;
  std::vector<TrajectoryPoint> points_;
};

void check(const std::vector<Pose2>& path, const RobotModel& robot) {
  const auto above_zero = [](double value, const char* name) {
    if (!(value > 0.0 && std::isfinite(value)))
      throw std::invalid_argument(std::string("trajectory_of: ") + name + " must be above 0, got " +
                                  std::to_string(value));
  };
  above_zero(robot.max_v_mps, "max_v_mps");
  above_zero(robot.max_w_radps, "max_w_radps");
  above_zero(robot.max_acceleration_mps2, "max_acceleration_mps2");
  above_zero(robot.max_turn_acceleration_radps2, "max_turn_acceleration_radps2");
  for (std::size_t i = 0; i < path.size(); ++i)
    if (!path[i].position().allFinite() || !std::isfinite(path[i].theta_rad))
      throw std::invalid_argument("trajectory_of: pose " + std::to_string(i) + " is not finite");
}

}  // namespace

std::vector<TrajectoryPoint> trajectory_of(const std::vector<Pose2>& path, const RobotModel& robot) {
  check(path, robot);
  if (path.empty()) return {};
  const bool can_turn = robot.kinematics == Kinematics::differential;
  std::vector<Leg> legs;
  const Pose2* last = &path.front();
  for (const Pose2& pose : path) {
    if ((pose.position() - last->position()).norm() <= kMinStep_m) {
      if (pose.position() == last->position()) last = &pose;  // it turns on the spot, then drives
      continue;
    }
    legs.push_back(leg_between(*last, pose, can_turn));
    last = &pose;
  }
  const auto goes_on = [](const Leg& a, const Leg& b) {
    return a.backwards == b.backwards && std::abs(wrap_angle(b.heading_rad - a.last_heading_rad())) < kMinTurn_rad;
  };
  TimedDrive drive(robot);
  drive.begin(path.front());
  for (std::size_t i = 0; i < legs.size();) {
    std::size_t end = i + 1;
    while (end < legs.size() && goes_on(legs[end - 1], legs[end])) ++end;
    drive.turn_to(legs[i].heading_rad);
    drive.drive(std::span(legs).subspan(i, end - i));
    i = end;
  }
  drive.turn_to(path.back().theta_rad);
  return std::move(drive).points();
}

}  // namespace cairn
