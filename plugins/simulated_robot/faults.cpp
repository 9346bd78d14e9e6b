#include "plugins/simulated_robot/faults.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cairn {
namespace {

constexpr std::uint64_t kFirstPurpose = 200;  // of the streams of the kinds
constexpr int kPlaceTries = 1000;

enum Kind : std::size_t { dead, stuck, slip, compass_jump, silent, kidnapping, deaf };

bool has_extent(const World& world) {
  return (world.max_m.array() > world.min_m.array()).all();
}

RobotModel round_robot(RobotModel robot) {
  for (const Point& corner : robot.polygon_m) robot.radius_m = std::max(robot.radius_m, corner.norm());
  robot.polygon_m.clear();
  return robot;
}

void check_sonar(double sonar, const RobotModel& robot, const SourcePlace& place) {
  if (sonar < static_cast<double>(robot.sonars.size())) return;
  const std::size_t count = robot.sonars.size();
  throw ConfigError(place, "the robot has no transducer " + config_detail::number_text(sonar) + "; it has " +
                               (count == 0 ? "none" : "0 to " + std::to_string(count - 1)));
}

void check(const FaultConfig& fault, const RobotModel& robot, const World& world) {
  for (const double sonar : fault.dead) check_sonar(sonar, robot, fault.place);
  if (fault.stuck) check_sonar(fault.stuck->sonar, robot, fault.place);
  if (!fault.kidnap) return;
  // It may be turned in any direction then: there must be room for all.
  const bool is_turned = fault.kidnap->angle_rad.has_value();
  const Pose2 T_map_put{fault.kidnap->to_m.x(), fault.kidnap->to_m.y(), fault.kidnap->angle_rad.value_or(0.0)};
  if (const auto why = not_free(T_map_put, is_turned ? robot : round_robot(robot), world))
    throw ConfigError(fault.place, "the robot cannot be put down at " + *why);
}

bool is_over(const FaultConfig& fault, double time_s) {
  return fault.for_s && time_s >= fault.at_s + *fault.for_s;
}

int one_of(std::size_t count, NoiseStream& noise) {
  return std::min(static_cast<int>(count) - 1, static_cast<int>(static_cast<double>(count) * noise.uniform()));
}

}  // namespace

std::optional<std::string> not_free(const Pose2& T_map_robot, const RobotModel& robot, const World& world) {
  char place[80];
  std::snprintf(place, sizeof place, "(%.2f, %.2f) m: ", T_map_robot.x_m, T_map_robot.y_m);
  const Point at_m = T_map_robot.position();
  // A world without an extent is an open field.
  if (has_extent(world) && ((at_m.array() < world.min_m.array()).any() || (at_m.array() > world.max_m.array()).any()))
    return std::string(place) + "it lies outside the world's bounds_m";
  const std::optional<std::string> blocker = blocker_at(T_map_robot, robot, world);
  if (!blocker) return std::nullopt;
  return std::string(place) + "it would overlap " + *blocker;
}

Faults::Faults(std::vector<FaultConfig> scheduled, const std::optional<RandomFaultsConfig>& random,
               const RobotModel& robot, const World& world, std::uint64_t seed)
    : robot_(robot), world_(world), to_come_(std::move(scheduled)), last_m_(robot.sonars.size()) {
  for (FaultConfig& fault : to_come_) {
    check(fault, robot, world);
    if (fault.deaf != RingPart::none) fault.dead = transducers_of(fault.deaf);
  }
  std::stable_sort(to_come_.begin(), to_come_.end(),
                   [](const FaultConfig& a, const FaultConfig& b) { return a.at_s < b.at_s; });
  if (!random) return;
  random_for_s_ = random->for_s;
  const FaultRates& rates = random->per_hour;
  std::size_t kind = 0;
  for (const double rate :
       {rates.dead, rates.stuck, rates.slip, rates.compass_jump, rates.silent, rates.kidnap, rates.deaf}) {
    if (rate > 0.0) {
      chances_.push_back({kind, rate, NoiseStream(seed, kFirstPurpose + kind), 0.0});
      chances_.back().wait();
    }
    ++kind;
  }
}

void Faults::PortableRandom::wait() {
  next_s -= std::log(1.0 - noise.uniform()) * 3600.0 / per_hour;
}

void Faults::advance(double time_s) {
  for (; !to_come_.empty() && to_come_.front().at_s <= time_s; to_come_.erase(to_come_.begin()))
    begin(to_come_.front());
  for (PortableRandom& chance : chances_)
    for (; chance.next_s <= time_s; chance.wait())
      if (auto fault = random_fault(chance.kind, chance.noise)) {
        fault->at_s = chance.next_s;
        begin(*fault);
      }
  std::erase_if(at_work_, [&](const FaultConfig& fault) { return is_over(fault, time_s); });
}

void Faults::begin(const FaultConfig& fault) {
  if (fault.kidnap)
    kidnaps_.push_back(*fault.kidnap);
  else
    at_work_.push_back(fault);
}

std::optional<FaultConfig> Faults::random_fault(std::size_t kind, NoiseStream& noise) const {
  FaultConfig fault;
  fault.for_s = random_for_s_;
  if ((kind == dead || kind == stuck || kind == deaf) && robot_.sonars.empty()) return std::nullopt;
  switch (kind) {
    case dead:
      fault.dead = {static_cast<double>(one_of(robot_.sonars.size(), noise))};
      break;
    case stuck:
      fault.stuck = StuckConfig{one_of(robot_.sonars.size(), noise), std::nullopt};
      break;
    case slip:
      fault.slip = SlipConfig{static_cast<Wheel>(one_of(3, noise)), 0.0};
      fault.slip->ratio = 0.1 + 0.8 * noise.uniform();
      break;
    case compass_jump:
      fault.compass_jump_rad = radians(90.0) * (2.0 * noise.uniform() - 1.0);
      break;
    case silent:
      fault.silent = true;
      break;
    case deaf:
      fault.dead = deaf_part(noise);
      break;
    default:
      fault.kidnap = free_place(noise);
      if (!fault.kidnap) return std::nullopt;
  }
  return fault;
}

// Numbers of the transducers that look there.
std::vector<double> Faults::transducers_of(RingPart part) const {
  constexpr double kStraight = 1e-6;
  std::vector<double> found;
  for (std::size_t i = 0; i < robot_.sonars.size(); ++i) {
    const double left = std::sin(robot_.sonars[i].T_robot_sonar.theta_rad);
    if ((part != RingPart::left || left > -kStraight) && (part != RingPart::right || left < kStraight))
      found.push_back(static_cast<double>(i));
  }
  return found;
}

// The whole, a half, or any of them.
std::vector<double> Faults::deaf_part(NoiseStream& noise) const {
  const int part = 1 + one_of(4, noise);
  if (part < 4) return transducers_of(static_cast<RingPart>(part));
  std::vector<double> some;
  for (std::size_t i = 0; i < robot_.sonars.size(); ++i)
    if (noise.uniform() < 0.5) some.push_back(static_cast<double>(i));
  return some;
}

std::optional<KidnapConfig> Faults::free_place(NoiseStream& noise) const {
  if (!has_extent(world_)) return std::nullopt;
  for (int i = 0; i < kPlaceTries; ++i) {
    const double x_m = world_.min_m.x() + noise.uniform() * (world_.max_m.x() - world_.min_m.x());
    const double y_m = world_.min_m.y() + noise.uniform() * (world_.max_m.y() - world_.min_m.y());
    const double angle_rad = 2.0 * std::numbers::pi * (noise.uniform() - 0.5);
    if (!not_free({x_m, y_m, angle_rad}, robot_, world_)) return KidnapConfig{{x_m, y_m}, angle_rad};
  }
  return std::nullopt;
}

std::optional<KidnapConfig> Faults::kidnap() const {
  return kidnaps_.empty() ? std::nullopt : std::optional(kidnaps_.front());
}

void Faults::kidnapped() {
  kidnaps_.erase(kidnaps_.begin());
}

std::optional<Twist> Faults::slipping(const Twist& turned) const {
  const double half_track_m = std::max(robot_.radius_m, 0.01);
  double left_mps = turned.v_mps - half_track_m * turned.w_radps;
  double right_mps = turned.v_mps + half_track_m * turned.w_radps;
  bool slips = false;
  for (const FaultConfig& fault : at_work_) {
    if (!fault.slip) continue;
    slips = true;
    if (fault.slip->wheel != Wheel::right) left_mps *= 1.0 - fault.slip->ratio;
    if (fault.slip->wheel != Wheel::left) right_mps *= 1.0 - fault.slip->ratio;
  }
  if (!slips) return std::nullopt;
  return Twist{0.5 * (left_mps + right_mps), 0.5 * (right_mps - left_mps) / half_track_m};
}

double Faults::compass_jump_rad() const {
  double jump_rad = 0.0;
  for (const FaultConfig& fault : at_work_) jump_rad += fault.compass_jump_rad.value_or(0.0);
  return jump_rad;
}

std::optional<RangeReading> Faults::reported(RangeReading reading) {
  std::optional<double>& last_m = last_m_[static_cast<std::size_t>(reading.sensor)];
  for (FaultConfig& fault : at_work_) {
    if (fault.silent) return std::nullopt;
    if (fault.stuck && fault.stuck->sonar == reading.sensor) {
      if (!fault.stuck->range_m) fault.stuck->range_m = last_m.value_or(reading.range_m);
      reading.range_m = *fault.stuck->range_m;
    }
    if (std::find(fault.dead.begin(), fault.dead.end(), reading.sensor) == fault.dead.end()) continue;
    if (fault.reads == DeadReading::nothing) return std::nullopt;
    reading.range_m = std::numeric_limits<double>::infinity();
  }
  last_m = reading.range_m;
  return reading;
}

}  // namespace cairn
