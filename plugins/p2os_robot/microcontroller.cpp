#include "plugins/p2os_robot/microcontroller.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "framework/live/steady_time.hpp"
#include "maps/base/spelling.hpp"
#include "plugins/p2os_robot/serial_port.hpp"

namespace cairn::p2os_robot {
namespace {

constexpr int kWait_ms = 20;
constexpr double kEchoWithin_s = 0.3;
constexpr int kSynchronisations = 3;
constexpr int kTries = 3;
constexpr double kMaxStep_m = 0.5;  // between two packets
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kCompassStep_rad = radians(2.0);
constexpr double kMaxDamagedRatio = 0.02;  // of packets
constexpr double kMotorsComeOnWithin_s = 1.0;

// Velocity and turn velocity 0.
std::vector<std::uint8_t> standing_bytes() {
  std::vector<std::uint8_t> bytes;
  for (const Command command : {Command::velocity, Command::turn_velocity}) {
    const CommandPacket packet(command, 0);
    bytes.insert(bytes.end(), packet.bytes().begin(), packet.bytes().end());
  }
  return bytes;
}

// Text that ends with 0, from there on.
std::string text_at(const std::vector<std::uint8_t>& data, std::size_t& at) {
  std::string text;
  while (at < data.size() && data[at] != 0) text += static_cast<char>(data[at++]);
  ++at;
  return text;
}

// The answer to the last synchronisation.
Identity identity_in(const std::vector<std::uint8_t>& echo) {
  std::size_t at = 1;
  Identity identity;
  for (std::string* text : {&identity.name, &identity.robot_class, &identity.subclass}) *text = text_at(echo, at);
  return identity;
}

// 0 is north, clockwise, in 2 degrees; some values say that there is none.
std::optional<double> heading_rad(int compass, double offset_rad) {
  if (compass == 0 || compass >= 181) return std::nullopt;
  return wrap_angle(offset_rad - compass * kCompassStep_rad);
}

}  // namespace

Microcontroller::Microcontroller(const Config& config, const RobotModel& robot)
    : config_(config),
      robot_(robot),
      nowhere_(::open("/dev/null", O_WRONLY | O_CLOEXEC)),
      line_(::fcntl(nowhere_.get(), F_DUPFD_CLOEXEC, 0)),
      odometry_(units_, kMaxStep_m) {
  if (!is_baud(config.baud))
    throw std::invalid_argument(
        fmt::format("p2os_robot: `baud` is {}; known are 9600, 19200, 38400, 57600, 115200", config.baud));
  if (!config.subclass.empty() && !units_of(config.subclass))
    throw std::invalid_argument(fmt::format("p2os_robot: `subclass` \"{}\" is not known{}", config.subclass,
                                            did_you_mean(config.subclass, known_subclasses())));
  if (config.battery_full_v <= config.battery_empty_v)
    throw std::invalid_argument(fmt::format("p2os_robot: `battery_full_v` {:g} must be above `battery_empty_v` {:g}",
                                            config.battery_full_v, config.battery_empty_v));
  if (robot.sonars.empty()) throw std::invalid_argument("p2os_robot: the robot's file has no sonars");
  if (line_.get() < 0) throw std::runtime_error("p2os_robot: no descriptor is left");
}

Microcontroller::~Microcontroller() {
  disconnect();
}

bool Microcontroller::connect(const Budget& budget, std::string& why) {
  try {
    const Descriptor port = open_serial_port(config_.device, config_.baud);
    ::dup3(port.get(), line_.get(), O_CLOEXEC);
  } catch (const std::runtime_error& error) {
    why = error.what();
    return false;
  }
  reader_.clear();
  // A robot that is still in the session of before turns its wheels again with any packet after its watchdog.
  if (identity_) (void)send_stop();
  const std::optional<Identity> identity = synchronised(budget, why);
  if (!identity) {
    disconnect();
    return false;
  }
  begin_session(*identity);
  return true;
}

std::optional<Identity> Microcontroller::synchronised(const Budget& budget, std::string& why) {
  why = "it does not answer: is it switched on, and is `baud` right?";
  std::optional<std::vector<std::uint8_t>> echo;
  int number = 0;
  for (int unanswered = 0; number < kSynchronisations && unanswered < kTries && !budget.exhausted();) {
    write(CommandPacket::synchronisation(number));
    const double until_s = live::now_s() + kEchoWithin_s;
    do echo = wait_for_packet(until_s, budget);
    while (echo && echo->front() < number);  // of an earlier one
    if (echo && echo->front() != number) {
      why = "it answers what is no synchronisation";
      break;
    }
    unanswered += echo ? 0 : 1;
    number = echo ? number + 1 : 0;  // from the beginning again
  }
  if (number == kSynchronisations) return identity_in(*echo);
  write(CommandPacket(Command::close));  // of an earlier session, which it may think it is in
  (void)wait_for_packet(live::now_s() + kEchoWithin_s, budget);
  return std::nullopt;
}

void Microcontroller::begin_session(const Identity& identity) {
  const std::string subclass = config_.subclass.empty() ? identity.subclass : config_.subclass;
  const std::optional<Units> units = units_of(subclass);
  if (!units)
    throw std::runtime_error(fmt::format(
        "calls itself {} ({}, subclass {}), and in which units that counts is not known; say what counts like it by "
        "`subclass`: {}",
        in_quotes(identity.name), in_quotes(identity.robot_class), in_quotes(identity.subclass),
        fmt::join(known_subclasses(), ", ")));
  units_ = *units;
  odometry_.begin_session(units_);
  identity_ = identity;
  packets_ = 0;
  begun_s_ = live::now_s();
  were_motors_on_ = false;
  write(CommandPacket(Command::open));
  (void)send_stop();
  {
    const std::scoped_lock lock(guarding_);
    // The microcontroller's own watchdog waits two seconds.
    guard_ =
        std::make_unique<live::GuardProcess>([port = line_.get(), stop = standing_bytes(),
                                              silence = std::chrono::milliseconds(std::lround(1e3 * config_.guard_s))](
                                                 int beats) { live::write_in_silence(beats, port, stop, silence); });
  }
  // Once: motors that somebody has switched off are not switched on because the line failed for a moment.
  if (units_.has_motor_switch && !has_enabled_motors_) write(CommandPacket(Command::enable_motors, 1));
  has_enabled_motors_ = true;
  write(CommandPacket(Command::sonar, 1));
}

void Microcontroller::disconnect() {
  {
    const std::scoped_lock lock(guarding_);
    guard_.reset();
  }
  (void)send_stop();
  write(CommandPacket(Command::close));
  ::dup3(nowhere_.get(), line_.get(), O_CLOEXEC);
}

bool Microcontroller::receive(std::vector<Observation>& seen) {
  const bool is_there = read_line() && guard_ && guard_->is_there();
  while (const auto data = reader_.next())
    if (const auto information = information_of(*data)) seen.push_back(observation_of(*information));
  return is_there;
}

std::vector<ConnectionPart> Microcontroller::parts() {
  ConnectionPart line{config_.device.string(), {{"baud", std::to_string(config_.baud)}}, {}};
  if (!identity_) return {line};
  line.values.push_back({"robot", in_quotes(identity_->name)});
  line.values.push_back({"class", in_quotes(identity_->robot_class)});
  line.values.push_back({"subclass", in_quotes(identity_->subclass)});
  if (battery_v_ > 0.0) line.values.push_back({"battery", fmt::format("{:.1f} V", battery_v_)});
  if (packets_ > 1 && last_packet_s_ > first_packet_s_)
    line.values.push_back(
        {"packets", fmt::format("{:.1f} a second", (packets_ - 1) / (last_packet_s_ - first_packet_s_))});
  line.values.push_back({"wrong checksums", std::to_string(reader_.damaged())});
  if (packets_ > 0) line.values.push_back({"age", fmt::format("{:.2f} s", live::now_s() - last_packet_s_)});
  if (!holder_.empty()) line.problem = "the robot is stopped by " + holder_ + ": it would not move";
  if (reader_.damaged() > kMaxDamagedRatio * packets_ + 1.0)
    line.problem = "many packets have a wrong checksum: is the cable sound, and does nothing else use the line?";
  return {line};
}

bool Microcontroller::read_line() {
  pollfd ready{line_.get(), POLLIN, 0};
  if (::poll(&ready, 1, kWait_ms) <= 0) return true;
  std::array<std::uint8_t, 1024> bytes;
  const ssize_t count = ::read(line_.get(), bytes.data(), bytes.size());
  if (count > 0) {
    reader_.take({bytes.data(), static_cast<std::size_t>(count)});
    return true;
  }
  return count < 0 && (errno == EAGAIN || errno == EINTR);
}

std::optional<std::vector<std::uint8_t>> Microcontroller::wait_for_packet(double until_s, const Budget& budget) {
  for (;;) {
    if (auto data = reader_.next()) return data;
    if (live::now_s() > until_s || budget.exhausted() || !read_line()) return std::nullopt;
  }
}

Observation Microcontroller::observation_of(const Information& seen) {
  Observation observation;
  observation.stamp_s = live::now_s();
  last_packet_s_ = observation.stamp_s;
  if (packets_++ == 0) first_packet_s_ = last_packet_s_;
  battery_v_ = seen.battery_v;
  observation.T_odom_robot = odometry_.pose_at(seen);
  if (config_.has_compass) observation.compass_rad = heading_rad(seen.compass, config_.compass_offset_rad);
  observation.bumped = seen.is_bumped || seen.is_stalled;
  holder_ = holder_of(seen);
  is_held_ = !holder_.empty();
  observation.stopped_by = holder_;
  if (seen.battery_v > 0.0)
    observation.battery_ratio = std::clamp(
        (seen.battery_v - config_.battery_empty_v) / (config_.battery_full_v - config_.battery_empty_v), 0.0, 1.0);
  for (const HeardSonar& heard : seen.sonars) {
    if (heard.number >= static_cast<int>(robot_.sonars.size()))
      throw std::runtime_error(
          fmt::format("has a sonar {}, the robot's file only 0 to {}", heard.number, robot_.sonars.size() - 1));
    const SonarModel& sonar = robot_.sonars[static_cast<std::size_t>(heard.number)];
    const double range_m = heard.range_counts * units_.range_m;
    RangeReading reading{sonar.T_robot_sonar, sonar.half_beam_rad, sonar.min_m, sonar.max_m, range_m, heard.number};
    if (range_m >= std::min(config_.no_echo_from_m, sonar.max_m)) reading.range_m = kInfinity;
    if (range_m < sonar.min_m) reading.range_m = -kInfinity;
    observation.ranges.push_back(reading);
  }
  return observation;
}

// At first they are off, until the order to switch them on has been obeyed. A person's button switches them on again.
std::string Microcontroller::holder_of(const Information& seen) {
  if (!units_.has_motor_switch) return {};
  if (seen.is_emergency) return "its emergency button";
  were_motors_on_ = were_motors_on_ || seen.are_motors_on;
  const bool may_be_coming_on = !were_motors_on_ && holder_.empty() && live::now_s() - begun_s_ < kMotorsComeOnWithin_s;
  if (seen.are_motors_on || may_be_coming_on) return {};
  return "its motors, which are switched off (press its MOTORS button)";
}

void Microcontroller::write(const CommandPacket& packet) noexcept {
  (void)write_now(line_.get(), packet.bytes());
}

void Microcontroller::send(const Twist& wanted) noexcept {
  const Twist twist = is_held_ ? Twist{} : wanted;
  write(CommandPacket(Command::velocity, static_cast<int>(std::lround(1e3 * twist.v_mps))));
  write(CommandPacket(Command::turn_velocity, static_cast<int>(std::lround(degrees(twist.w_radps)))));
}

void Microcontroller::send_pulse() noexcept {
  write(CommandPacket(Command::pulse));
}

void Microcontroller::beat() noexcept {
  const std::unique_lock lock(guarding_, std::try_to_lock);
  if (lock.owns_lock() && guard_) guard_->beat();
}

bool Microcontroller::send_stop() noexcept {
  const int error = errno;
  write(CommandPacket(Command::velocity, 0));
  write(CommandPacket(Command::turn_velocity, 0));
  errno = error;
  return true;
}

}  // namespace cairn::p2os_robot
