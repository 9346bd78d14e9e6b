#include "plugins/behaviours/following/back_up.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::behaviours {

void BackUpSettings::describe(Fields<BackUpSettings>& fields) {
  using C = BackUpSettings;
  fields.number("speed_mps", &C::speed_mps, {0.001, 1.0}, "m/s",
                "speed backwards: few robots see well behind, so what is touched must not be pushed");
  fields.number("distance_m", &C::distance_m, {0.0, 5.0}, "m", "how far it backs up");
  fields.number("at_most_s", &C::at_most_s, {0.0, 600.0}, "s", "for how long at most");
}

void BackUp::begin(const WorldView& world, int times) {
  from_ = world.pose.T_map_robot.position();
  begun_s_ = world.time_s;
  times_ = times;
}

std::optional<Twist> BackUp::tick(const WorldView& world, const IsBlocked& is_blocked) const {
  const Pose2& pose = world.pose.T_map_robot;
  const std::vector<Point> behind{pose.position(), pose * Point{-settings_.distance_m, 0.0}};
  const bool is_over = (pose.position() - from_).norm() >= times_ * settings_.distance_m ||
                       world.time_s - begun_s_ > times_ * settings_.at_most_s ||
                       is_blocked(behind, 0.5 * settings_.distance_m, settings_.distance_m);
  if (is_over) return std::nullopt;
  return Twist{-settings_.speed_mps, 0.0};
}

void TurnRoundSettings::describe(Fields<TurnRoundSettings>& fields) {
  using C = TurnRoundSettings;
  fields.angle("first_deg", &C::first_rad, {0.0, 720.0}, "how far it turns the first time");
  fields.angle("later_deg", &C::later_rad, {0.0, 720.0}, "and the later times");
  fields.angle("speed_degps", &C::speed_radps, {1.0, 360.0}, "how fast", "deg/s");
  fields.number("at_most_s", &C::at_most_s, {0.0, 600.0}, "s", "for how long at most");
}

void TurnRound::begin(const WorldView& world, bool is_first) {
  left_rad_ = is_first ? settings_.first_rad : settings_.later_rad;
  last_theta_rad_ = world.pose.T_map_robot.theta_rad;
  begun_s_ = world.time_s;
}

std::optional<Twist> TurnRound::tick(const WorldView& world) {
  const double theta_rad = world.pose.T_map_robot.theta_rad;
  left_rad_ -= std::abs(wrap_angle(theta_rad - last_theta_rad_));
  last_theta_rad_ = theta_rad;
  const bool can_turn = world.robot.kinematics == Kinematics::differential;
  if (!can_turn || left_rad_ <= 0.0 || world.time_s - begun_s_ > settings_.at_most_s) return std::nullopt;
  return Twist{0.0, std::min(settings_.speed_radps, world.robot.max_w_radps)};
}

}  // namespace cairn::behaviours
