#include "plugins/p2os_robot/information.hpp"

namespace cairn::p2os_robot {
namespace {

constexpr std::uint8_t kStanding = 0x32;
constexpr std::uint8_t kMoving = 0x33;
constexpr std::size_t kBeforeSonars = 20;
constexpr std::size_t kSonar = 3;
constexpr unsigned kPosition = 0x7FFF;
constexpr unsigned kStall = 0x01;     // of each of the two bytes of stalls and bumpers
constexpr unsigned kBumper = 0xFE;    // the same
constexpr unsigned kMotorsOn = 0x01;  // of the flags
constexpr unsigned kEmergency = 0x20;

}  // namespace

std::optional<Information> information_of(std::span<const std::uint8_t> data) {
  if (data.size() < kBeforeSonars || (data[0] != kStanding && data[0] != kMoving)) return std::nullopt;
  const auto word = [&](std::size_t at) {
    return static_cast<unsigned>(data[at]) | static_cast<unsigned>(data[at + 1]) << 8U;
  };
  Information seen;
  seen.x_counts = static_cast<int>(word(1) & kPosition);
  seen.y_counts = static_cast<int>(word(3) & kPosition);
  seen.heading_counts = static_cast<std::int16_t>(word(5));
  seen.battery_v = data[11] / 10.0;
  seen.is_stalled = ((data[12] | data[13]) & kStall) != 0;
  seen.is_bumped = ((data[12] | data[13]) & kBumper) != 0;
  seen.are_motors_on = (word(16) & kMotorsOn) != 0;
  seen.is_emergency = (word(16) & kEmergency) != 0;
  seen.compass = data[18];
  const std::size_t count = data[19];
  if (data.size() < kBeforeSonars + kSonar * count) return std::nullopt;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = kBeforeSonars + kSonar * i;
    seen.sonars.push_back({data[at], static_cast<int>(word(at + 1))});
  }
  return seen;
}

}  // namespace cairn::p2os_robot
