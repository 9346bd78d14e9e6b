#include "framework/safety/velocity_limiter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/safety/swept_footprint.hpp"

namespace cairn {
namespace {

constexpr double kCreep_mps = SpeedLaw{}.creep_mps;  // where nobody looks, too
constexpr double kBlindPeriods = 1.5;                // of firing: the second reading in a row that is missing
constexpr double kLongestBlind_s = 1.0;              // as blind_s, where the period is measured
constexpr std::size_t kGaps = 5;
constexpr double kBumpSide_rad = radians(40.0);

// Its own zones alone: the controller sees to its.
SpeedLaw law_of(const CollisionMonitorConfig& config) {
  SpeedLaw law = config.speed_law();
  law.tight_m = 0.0;
  return law;
}

// The largest share k of a speed with which the robot stands before distance_m is used up, when what it might meet
// comes towards it at closing_mps as long as it moves:  k V t + (k V)^2 / 2a + u (t + k V / a) <= distance.
double share_for(double distance_m, double speed_mps, double deceleration_mps2, const SeenPoint& seen, double tick_s) {
  const double reaction_s = tick_s + seen.until_fired_s;
  const double a = speed_mps * speed_mps / (2.0 * deceleration_mps2);
  const double b = speed_mps * reaction_s + seen.closing_mps * speed_mps / deceleration_mps2;
  const double c = seen.closing_mps * reaction_s - distance_m;
  if (c >= 0.0) return 0.0;
  return std::min(1.0, (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a));
}

// Nothing farther away can come into a zone before the robot stands: it may take a scan's time to see it.
double rays_within_m(const CollisionMonitorConfig& config, const RobotModel& robot) {
  const double reach_m = reach_of_m(robot);
  const double speed_mps = robot.max_v_mps + reach_m * robot.max_w_radps;
  const double stopping_s = 0.3 + std::min(1.0, reading_period_s(robot)) + speed_mps / robot.max_acceleration_mps2;
  return reach_m + config.margin_m + config.slow_m + (speed_mps + kFastestMover_mps) * stopping_s + 0.5;
}

}  // namespace

VelocityLimiter::VelocityLimiter(const CollisionMonitorConfig& config, const RobotModel& robot)
    : config_(config),
      law_(law_of(config)),
      robot_(robot),
      memory_(robot, config.stale_s, rays_within_m(config, robot)),
      hearing_(config.deaf, memory_.kept_s()),
      period_s_(reading_period_s(robot)) {}

void VelocityLimiter::see(const Observation& observation, std::span<const ExpectedEcho> expected) {
  const double passed_s = observation.stamp_s - stamp_s_;
  const bool jumped_back = begun_ && passed_s <= 0.0;
  useless_ = jumped_back || !is_placed(observation);
  if (useless_) {
    // What was seen before is of no known time or place; a clock that has jumped back goes on from there.
    memory_.forget();
    hearing_.forget();
    if (jumped_back) stamp_s_ = last_reading_s_ = observation.stamp_s;
    return;
  }
  if (begun_) tick_s_ = passed_s;
  if (!begun_) last_reading_s_ = observation.stamp_s;
  begun_ = true;
  stamp_s_ = observation.stamp_s;
  memory_.see(observation);
  hearing_.see(observation, expected);
  if (std::any_of(observation.ranges.begin(), observation.ranges.end(), says_something)) note_reading();
  feel_bump(observation.bumped);
}

// The second largest of the last few gaps: neither a reading that is missing nor a stamp that jitters changes it, and
// of two sources that report their readings one soon after the other it is the long one.
void VelocityLimiter::note_reading() {
  if (heard_ && reading_period_s(robot_) <= 0.0) {
    if (gaps_s_.size() == kGaps) gaps_s_.erase(gaps_s_.begin());
    gaps_s_.push_back(stamp_s_ - last_reading_s_);
    std::vector<double> sorted = gaps_s_;
    std::ranges::sort(sorted);
    period_s_ = std::min(sorted[sorted.size() < 2 ? 0 : sorted.size() - 2], kLongestBlind_s / kBlindPeriods);
  }
  heard_ = true;
  last_reading_s_ = stamp_s_;
}

// A bump says that, not where: when it begins, at the side that the robot was going to. As long as it lasts (somebody
// leans on the robot from behind) the robot only creeps.
void VelocityLimiter::feel_bump(bool bumped) {
  if (bumped && !bumped_ && allowed_.v_mps != 0.0) {
    const double side_rad = allowed_.v_mps > 0.0 ? 0.0 : std::numbers::pi;
    for (const double off_rad : {-kBumpSide_rad, 0.0, kBumpSide_rad})
      memory_.feel(robot_.radius_m * Point(std::cos(side_rad + off_rad), std::sin(side_rad + off_rad)));
    hearing_.feel_bump(side_rad);
  }
  bumped_ = bumped;
  if (bumped) driven_ = {};
}

bool VelocityLimiter::is_blind_for_long() const {
  return begun_ && is_stale() && (useless_ || stamp_s_ - last_reading_s_ > config_.command_valid_s);
}

bool VelocityLimiter::is_stale() const {
  const double blind_s = config_.blind_s.value_or(kBlindPeriods * period_s_);
  return !begun_ || useless_ || stamp_s_ - last_reading_s_ > blind_s;
}

// Of the twist: 1 all of it, 0 nothing.
double VelocityLimiter::allowed_share(const Twist& twist, double margin_m) const {
  const double speed_mps = sweep_speed_mps(robot_, twist);
  if (speed_mps <= 0.0) return 1.0;
  const double braking_mps2 = robot_.max_acceleration_mps2;
  double share = 1.0;
  for (const SeenPoint& seen : memory_.points()) {
    const double stopping_s = tick_s_ + seen.until_fired_s + speed_mps / braking_mps2;
    const double horizon_m = (speed_mps + seen.closing_mps) * stopping_s;
    const double way_m = free_sweep_m(robot_, twist, seen.at, margin_m, horizon_m);
    if (std::isfinite(way_m)) share = std::min(share, share_for(way_m, speed_mps, braking_mps2, seen, tick_s_));
  }
  return share;
}

Twist VelocityLimiter::within_limits(const Twist& wanted) const {
  Twist within{std::clamp(wanted.v_mps, -robot_.max_v_mps, robot_.max_v_mps),
               std::clamp(wanted.w_radps, -robot_.max_w_radps, robot_.max_w_radps)};
  if (robot_.kinematics == Kinematics::car && robot_.min_turning_radius_m > 0.0) {
    const double tightest_radps = std::abs(within.v_mps) / robot_.min_turning_radius_m;
    within.w_radps = std::clamp(within.w_radps, -tightest_radps, tightest_radps);
  }
  return within;
}

// What the robot drives a tick later when this is commanded.
Twist VelocityLimiter::next_towards(const Twist& twist) const {
  return within_limits({approached(driven_.v_mps, twist.v_mps, robot_.max_acceleration_mps2 * tick_s_),
                        approached(driven_.w_radps, twist.w_radps, robot_.max_turn_acceleration_radps2 * tick_s_)});
}

// Slowing down keeps the curve: turn rate falls with the speed, except when a disc has only turning left.
Twist VelocityLimiter::cut(const Twist& clamped) const {
  const double speed_mps = sweep_speed_mps(robot_, clamped);
  if (speed_mps <= 0.0) return clamped;  // a disc that turns in place
  const double v_mps = std::abs(clamped.v_mps);
  const double slow_mps = std::max(allowed_speed_mps(config_.margin_m, robot_.max_v_mps, law_),  // in the slow zone
                                   speed_mps * allowed_share(clamped, config_.margin_m + config_.slow_m));
  double max_mps = std::min(speed_mps, slow_mps);
  if (bumped_) max_mps = std::min(max_mps, kCreep_mps);
  // It is not on the wanted arc yet. Down to a creep only, so that it can always turn away from where it stands.
  const Twist next = next_towards(clamped);
  const bool is_braking =
      clamped.v_mps != 0.0 ? next.v_mps * clamped.v_mps <= 0.0 : next.w_radps * clamped.w_radps <= 0.0;
  const double next_share = is_braking ? 1.0 : allowed_share(next, config_.margin_m);
  if (next_share < 1.0) max_mps = std::min(max_mps, std::max(kCreep_mps, next_share * sweep_speed_mps(robot_, next)));
  double share = std::min(max_mps / speed_mps, allowed_share(clamped, config_.margin_m));
  if (v_mps > kCreep_mps && !memory_.covers(clamped.v_mps > 0.0 ? 0.0 : std::numbers::pi))
    share = std::min(share, kCreep_mps / v_mps);
  if (const double unheard_mps = max_unheard_mps(clamped); v_mps > unheard_mps)
    share = std::min(share, unheard_mps / v_mps);
  if (share >= 1.0) return clamped;
  if (share <= 0.0) return {0.0, robot_.polygon_m.empty() ? clamped.w_radps : 0.0};
  return {share * clamped.v_mps, share * clamped.w_radps};
}

// Of a motion to where transducers are deaf.
double VelocityLimiter::max_unheard_mps(const Twist& twist) const {
  if (twist.v_mps == 0.0) return std::numeric_limits<double>::infinity();
  if (hearing_.is_towards(twist.v_mps > 0.0 ? 0.0 : std::numbers::pi)) return kCreep_mps;
  return hearing_.is_ring_silent() ? config_.deaf.silent_mps : std::numeric_limits<double>::infinity();
}

Twist VelocityLimiter::limit(const Twist& wanted) {
  allowed_ = allowed_of(wanted);
  driven_ = next_towards(allowed_);
  return allowed_;
}

Twist VelocityLimiter::allowed_of(const Twist& wanted) {
  if (!std::isfinite(wanted.v_mps) || !std::isfinite(wanted.w_radps)) return {};
  const Twist clamped = within_limits(wanted);
  if (clamped == Twist{}) return {};
  if (is_stale()) {
    figures_.stale_s += tick_s_;
    return {};
  }
  const Twist allowed = cut(clamped);
  const bool moves = allowed.v_mps != 0.0 || (clamped.v_mps == 0.0 && allowed.w_radps != 0.0);
  if (!moves) figures_.stopped_s += tick_s_;
  if (moves && allowed != clamped) figures_.slowed_s += tick_s_;
  if (moves && std::abs(clamped.v_mps) > max_unheard_mps(clamped)) figures_.deaf_s += tick_s_;
  return allowed;
}

double VelocityLimiter::speed_reduction_ratio(const Twist& wanted, const Twist& allowed) const {
  const auto left_out = [](double whole, double part, double most) {
    return whole == 0.0 ? 0.0 : 1.0 - std::min(1.0, std::abs(part) / std::min(std::abs(whole), most));
  };
  return wanted.v_mps != 0.0 ? left_out(wanted.v_mps, allowed.v_mps, robot_.max_v_mps)
                             : left_out(wanted.w_radps, allowed.w_radps, robot_.max_w_radps);
}

}  // namespace cairn
