#include "plugins/simulated_robot/surroundings/witness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

constexpr double kMemory_s = 1.0;  // and as long as it takes to stop from top speed
constexpr double kReaction_s = 0.3;
constexpr double kPart_m = 0.1;            // so far from the place of the touch belongs to what was touched
constexpr double kRay_rad = radians(1.0);  // half a beam that has no width
constexpr double kBack_m = 1e-4;

double closing_speed_mps(const Body& body, const Pose2& T_map_robot, const Twist& going) {
  const double speed = std::abs(going.v_mps) + std::abs(going.w_radps);
  if (speed == 0.0) return 0.0;
  const double ago_s = kBack_m / speed;
  const Pose2 T_map_before = T_map_robot * along_arc(-going.v_mps * ago_s, -going.w_radps * ago_s);
  return std::max(0.0, (body.clearance_m(T_map_before) - body.clearance_m(T_map_robot)) / ago_s);
}

// The place of the touch and its neighbours on the same face.
std::array<Point, 3> parts_of(const Nearest& touched) {
  const Point& at_m = touched.at_m;
  if (touched.face != nullptr) {
    const Face& face = *touched.face;
    const Point along = kPart_m * (face.b_m - face.a_m).normalized();
    return {at_m, nearest_on_segment(at_m - along, face.a_m, face.b_m),
            nearest_on_segment(at_m + along, face.a_m, face.b_m)};
  }
  const RoundFace& face = *touched.round_face;
  const double turn_rad = std::min(kPart_m / face.radius_m, radians(90.0));
  const Point from_centre = at_m - face.centre_m;
  return {at_m, face.centre_m + Pose2{0, 0, turn_rad} * from_centre,
          face.centre_m + Pose2{0, 0, -turn_rad} * from_centre};
}

// One transducer fires after the other: nobody has looked everywhere before a round is over.
double round_s(const RobotModel& robot) {
  const std::size_t order = robot.firing_order.empty() ? robot.sonars.size() : robot.firing_order.size();
  return static_cast<double>(order) * robot.firing_period_s;
}

}  // namespace

Witness::Witness(const RobotModel& robot) : robot_(robot), reaction_s_(std::max(kReaction_s, round_s(robot))) {}

void Witness::note(double time_s, const Pose2& T_map_robot, const Places& places) {
  const double memory_s = kMemory_s + reaction_s_ + robot_.max_v_mps / robot_.max_acceleration_mps2;
  while (!moments_.empty() && moments_.front().time_s < time_s - memory_s) moments_.pop_front();
  Moment moment{time_s, T_map_robot, places, 0.0, 0.0};
  if (!moments_.empty()) {
    const Moment& last = moments_.back();
    const double moved_m = (T_map_robot.position() - last.T_map_robot.position()).norm();
    moment.driven_m = last.driven_m + moved_m;
    if (time_s > last.time_s) moment.speed_mps = moved_m / (time_s - last.time_s);
  }
  moments_.push_back(std::move(moment));
}

// By now, had it braked for what it saw then.
bool Witness::could_stand(const Moment& seen) const {
  const double since_s = moments_.back().time_s - seen.time_s;
  const double brake_s = seen.speed_mps / robot_.max_acceleration_mps2;
  const double stop_m = seen.speed_mps * (reaction_s_ + 0.5 * brake_s);
  const bool had_room = moments_.back().driven_m - seen.driven_m >= stop_m;
  return since_s >= reaction_s_ && (had_room || since_s >= reaction_s_ + brake_s);
}

Contact Witness::judge(const Body& body, const Scene& scene, const Traffic& traffic, const Pose2& T_map_robot,
                       const Twist& going) const {
  const Nearest touched = body.nearest(T_map_robot);
  return {closing_speed_mps(body, T_map_robot, going), could_see(touched, scene, traffic)};
}

bool Witness::could_see(const Nearest& touched, const Scene& scene, const Traffic& traffic) const {
  if (touched.face == nullptr && touched.round_face == nullptr) return false;
  const int mover = touched.face != nullptr ? touched.face->mover : touched.round_face->mover;
  const std::array<Point, 3> parts_m = parts_of(touched);
  Scene then = scene;
  return std::any_of(moments_.begin(), moments_.end(), [&](const Moment& moment) {
    if (!could_stand(moment)) return false;
    Point shift_m(0.0, 0.0);
    if (mover != kFixed) {
      const auto index = static_cast<std::size_t>(mover);
      if (!moment.places[index]) return false;
      shift_m = *moment.places[index] - *traffic.places()[index];
    }
    traffic.show(moment.places, then);
    return std::any_of(parts_m.begin(), parts_m.end(),
                       [&](const Point& part_m) { return is_in_a_beam(moment.T_map_robot, part_m + shift_m, then); });
  });
}

bool Witness::is_in_a_beam(const Pose2& T_map_robot, const Point& p_m, const Scene& scene) const {
  const auto is_scanned = [&](const LaserModel& laser) {
    const Pose2 T_map_laser = T_map_robot * laser.T_robot_laser;
    const Point seen_m = inverse(T_map_laser) * p_m;
    if (seen_m.norm() > laser.max_m) return false;
    const double middle_rad = 0.5 * (laser.first_angle_rad + laser.last_angle_rad);
    const double half_rad = 0.5 * std::abs(laser.last_angle_rad - laser.first_angle_rad) + kRay_rad;
    const double off_rad = std::abs(wrap_angle(std::atan2(seen_m.y(), seen_m.x()) - middle_rad));
    return off_rad <= half_rad && scene.sees(T_map_laser.position(), p_m);
  };
  if (std::ranges::any_of(robot_.lasers, is_scanned)) return true;
  return std::any_of(robot_.sonars.begin(), robot_.sonars.end(), [&](const SonarModel& sonar) {
    const Pose2 T_map_sonar = T_map_robot * sonar.T_robot_sonar;
    const Point seen_m = inverse(T_map_sonar) * p_m;
    if (seen_m.norm() > sonar.max_m) return false;
    if (std::abs(std::atan2(seen_m.y(), seen_m.x())) > std::max(sonar.half_beam_rad, kRay_rad)) return false;
    return scene.sees(T_map_sonar.position(), p_m);
  });
}

}  // namespace cairn
