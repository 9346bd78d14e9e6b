#include "plugins/pursuit_dwa/dynamic_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cairn::pursuit_dwa {
namespace {

double braking_distance_m(double v_mps, const WindowLimits& limits, const WindowSettings& settings) {
  return v_mps * v_mps / (2.0 * settings.braking_ratio * limits.accelerations.forward_mps2) +
         settings.reaction_s * v_mps;
}

struct Window {
  double min_v_mps, max_v_mps, min_w_radps, max_w_radps;
};

Window window_about(const Twist& now, const WindowLimits& limits, const WindowSettings& settings) {
  const double dv = limits.accelerations.forward_mps2 * settings.window_s;
  const double dw = limits.accelerations.turn_radps2 * settings.window_s;
  return {std::max(settings.min_speed_mps, now.v_mps - dv),
          std::max(settings.min_speed_mps, std::min(limits.max_v_mps, now.v_mps + dv)),
          std::max(-limits.max_w_radps, now.w_radps - dw), std::min(limits.max_w_radps, now.w_radps + dw)};
}

bool can_steer(const Twist& twist, const motion::Accelerations& limits) {
  return limits.min_turning_radius_m <= 0.0 ||
         std::abs(twist.w_radps) * limits.min_turning_radius_m <= twist.v_mps + 1e-9;
}

// Its own zone alone: the collision monitor sees to the others.
SpeedLaw law_of(const WindowSettings& settings) {
  SpeedLaw law;
  law.margin_m = law.slow_m = 0.0;
  law.tight_m = settings.clearance_m;
  law.tight_mps = settings.tight_speed_mps;
  return law;
}

// One search of the window, at one clearance and top speed.
struct Search {
  double clearance_m;
  double max_v_mps;
  const Twist& now;
  const Wish& wish;
  std::span<const Point> obstacles;
  const WindowLimits& limits;
  const WindowSettings& settings;

  [[nodiscard]] double free_m(const Twist& twist) const {
    return free_distance_m(twist, obstacles, limits.radius_m + clearance_m, settings);
  }

  // Eq. 13.
  [[nodiscard]] double score(const Twist& twist, double free_m) const {
    const Point end = pose_after(twist, settings.judged_after_s).position();
    const Point to_aim = wish.aim - end;
    const double facing_rad = twist.w_radps * settings.judged_after_s;
    const double error_rad = to_aim.norm() < 0.05 ? 0.0 : wrap_angle(std::atan2(to_aim.y(), to_aim.x()) - facing_rad);
    const double heading = 1.0 - std::abs(error_rad) / std::numbers::pi;
    const double clearance = std::min(free_m, settings.far_m) / settings.far_m;
    const double difference = std::abs(twist.w_radps - wish.preferred.w_radps) / std::max(0.1, limits.max_w_radps);
    return settings.heading_weight * heading + settings.clearance_weight * clearance +
           settings.speed_weight * twist.v_mps / limits.max_v_mps - settings.preference_weight * difference;
  }

  // The preferred velocity, no faster than allowed here.
  [[nodiscard]] Twist preferred() const {
    const double share = std::min(1.0, max_v_mps / std::max(1e-9, wish.preferred.v_mps));
    return {share * wish.preferred.v_mps, share * wish.preferred.w_radps};
  }
  [[nodiscard]] bool is_free(const Twist& twist) const {
    const double needed_m = braking_distance_m(twist.v_mps, limits, settings) + settings.spare_m;
    return free_m(twist) >= std::min(needed_m, std::max(wish.aim.norm(), 0.02));
  }

  [[nodiscard]] WindowStep best() const {
    if (is_free(preferred())) return {preferred(), false};
    const Window window = window_about(now, limits, settings);
    WindowStep best{{}, true};
    double best_score = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < settings.speeds; ++i) {
      const double fastest =
          std::min({window.max_v_mps, max_v_mps, std::max(wish.preferred.v_mps, settings.min_speed_mps)});
      const double slowest = std::min(window.min_v_mps, fastest);
      const double v_mps = slowest + (fastest - slowest) * i / (settings.speeds - 1);
      for (int k = 0; k < settings.turn_rates; ++k) {
        const double w_radps =
            window.min_w_radps + (window.max_w_radps - window.min_w_radps) * k / (settings.turn_rates - 1);
        const Twist twist{v_mps, w_radps};
        if (!can_steer(twist, limits.accelerations)) continue;
        const double ahead_m = free_m(twist);
        if (ahead_m < braking_distance_m(v_mps, limits, settings)) continue;
        const double value = score(twist, ahead_m);
        if (value <= best_score) continue;
        best_score = value;
        best = {twist, false};
      }
    }
    return best;
  }
};

}  // namespace

void WindowSettings::describe(Fields<WindowSettings>& fields) {
  using C = WindowSettings;
  fields.number("clearance_m", &C::clearance_m, {0.0, 2.0}, "m",
                "kept between the robot's disc and obstacles; more than the collision monitor's margin");
  fields.number("tight_clearance_m", &C::tight_clearance_m, {0.0, 2.0}, "m", "the same where there is no more room");
  fields.number("tight_speed_mps", &C::tight_speed_mps, {0.01, 5.0}, "m/s", "top speed at the tight clearance");
  fields.number("window_s", &C::window_s, {0.05, 5.0}, "s",
                "candidates are the velocities that the robot can reach within this time");
  fields.integer("speeds", &C::speeds, {2.0, 50.0}, "speeds of the candidates");
  fields.integer("turn_rates", &C::turn_rates, {2.0, 200.0}, "turn rates of the candidates");
  fields.number("judged_after_s", &C::judged_after_s, {0.1, 10.0}, "s",
                "a candidate's heading is judged by where it leads in this time");
  fields.number("reaction_s", &C::reaction_s, {0.0, 5.0}, "s", "until the robot brakes; about a round of the sonars");
  fields.number("braking_ratio", &C::braking_ratio, {0.05, 1.0}, "",
                "share of the robot's deceleration that braking counts on, so that the collision monitor need not act");
  fields.number("spare_m", &C::spare_m, {0.0, 2.0}, "m",
                "the path's own velocity is kept when its arc is free for so much more than the braking distance");
  fields.number("far_m", &C::far_m, {0.05, 20.0}, "m", "a free distance beyond this is no better");
  fields.number("min_speed_mps", &C::min_speed_mps, {0.001, 1.0}, "m/s", "slowest candidate");
  fields.number("heading_weight", &C::heading_weight, {0.0, 100.0}, "", "weight of the heading towards the path");
  fields.number("clearance_weight", &C::clearance_weight, {0.0, 100.0}, "", "weight of the free distance");
  fields.number("speed_weight", &C::speed_weight, {0.0, 100.0}, "", "weight of the speed");
  fields.number("preference_weight", &C::preference_weight, {0.0, 100.0}, "",
                "weight of the turn rate that the path asks for: of two candidates as good, the one nearer to it");
  fields.number("contact_step_m", &C::contact_step_m, {0.001, 1.0}, "m",
                "along an obstacle that is within the clearance already, an arc is judged by its first metres: these");
  fields.number("contact_ratio", &C::contact_ratio, {0.0, 1.0}, "",
                "share of them by which it may come nearer to that obstacle");
}

WindowLimits window_limits(const RobotModel& robot, double speed_mps, double max_turn_radps) {
  WindowLimits limits;
  limits.max_v_mps = std::min(speed_mps, robot.max_v_mps);
  limits.max_w_radps = max_turn_radps;
  limits.accelerations = motion::accelerations_of(robot);
  limits.radius_m = robot.radius_m;
  return limits;
}

double free_distance_m(const Twist& twist, std::span<const Point> obstacles, double reach_m,
                       const WindowSettings& settings) {
  const double sign = twist.v_mps < 0.0 ? -1.0 : 1.0;
  const double curvature = twist.w_radps / twist.v_mps;
  const Point soon = pose_after(twist, settings.contact_step_m / std::abs(twist.v_mps)).position();
  double free_m = std::numeric_limits<double>::infinity();
  for (const Point& p : obstacles) {
    const double distance2 = p.squaredNorm();
    if (distance2 < reach_m * reach_m) {
      if ((p - soon).norm() < std::sqrt(distance2) - settings.contact_ratio * settings.contact_step_m) return 0.0;
      continue;
    }
    if (std::abs(curvature) < 1e-3) {
      const double ahead_m = sign * p.x();
      if (ahead_m <= 0.0 || std::abs(p.y()) >= reach_m) continue;
      free_m = std::min(free_m, ahead_m - std::sqrt(reach_m * reach_m - p.y() * p.y()));
      continue;
    }
    // The robot goes round (0, 1 / curvature); where its circle meets the one about the obstacle.
    const double radius_m = 1.0 / std::abs(curvature);
    const Point q(sign * p.x(), curvature > 0.0 ? p.y() : -p.y());  // mirrored: forward and to the left
    const Point from_centre = q - Point(0.0, radius_m);
    const double d_m = from_centre.norm();
    if (d_m < 1e-9 || d_m >= radius_m + reach_m || d_m <= radius_m - reach_m) continue;
    const double cosine = (radius_m * radius_m + d_m * d_m - reach_m * reach_m) / (2.0 * radius_m * d_m);
    double angle_rad = std::atan2(from_centre.x(), -from_centre.y()) - std::acos(std::clamp(cosine, -1.0, 1.0));
    if (angle_rad < 0.0) angle_rad += 2.0 * std::numbers::pi;
    free_m = std::min(free_m, radius_m * angle_rad);
  }
  return free_m;
}

WindowStep best_in_window(const Twist& now, const Wish& wish, std::span<const Point> obstacles,
                          const WindowLimits& limits, const WindowSettings& settings) {
  // A disc that turns in place sweeps nothing new.
  if (wish.preferred.v_mps == 0.0) return {wish.preferred, false};
  const WindowStep step = Search{settings.clearance_m, limits.max_v_mps, now, wish, obstacles, limits, settings}.best();
  if (!step.blocked) return step;
  const double tight_m = std::min(settings.tight_clearance_m, settings.clearance_m);
  const double tight_mps = allowed_speed_mps(0.0, limits.max_v_mps, law_of(settings));
  return Search{tight_m, tight_mps, now, wish, obstacles, limits, settings}.best();
}

}  // namespace cairn::pursuit_dwa
