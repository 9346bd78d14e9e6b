#include "plugins/common/ros/sensor_places.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "maps/base/spelling.hpp"

namespace cairn::ros {
namespace {

constexpr double kMaxOff_m = 0.05;
constexpr double kMaxOff_rad = radians(10.0);
constexpr double kKnownWithin_s = 5.0;
constexpr std::ptrdiff_t kMaxFramesListed = 8;

std::string text_of(const Pose2& pose) {
  return fmt::format("({:.2f}, {:.2f}) m, {:.0f} deg", pose.x_m, pose.y_m, degrees(pose.theta_rad));
}

}  // namespace

std::optional<frames::Mounted> SensorPlaces::of_sensor(const std::string& frame, const Pose2& T_robot_sensor,
                                                       double now_s) {
  const frames::Mounted by_file{T_robot_sensor, false};
  if (mounting_ == Mounting::file) return by_file;
  const std::optional<frames::Mounted> by_frames = frames_.find(base_, frame);
  if (mounting_ == Mounting::frames) {
    if (!by_frames) wait_for(frame, now_s);
    return by_frames;
  }
  if (!by_frames) return by_file;
  const Pose2 off = inverse(T_robot_sensor) * by_frames->T_base_sensor;
  if (off.position().norm() > kMaxOff_m || std::abs(off.theta_rad) > kMaxOff_rad)
    throw std::runtime_error(fmt::format(
        "the sensor \"{}\" is at {} from \"{}\" by {}, and at {} by the robot's file; correct the file, or say "
        "`mounting: frames` or `mounting: file`",
        frame, text_of(by_frames->T_base_sensor), base_, topic_, text_of(T_robot_sensor)));
  return frames::Mounted{T_robot_sensor, by_frames->is_upside_down};
}

std::optional<frames::Mounted> SensorPlaces::of_frame(const std::string& frame, double now_s) {
  if (mounting_ == Mounting::file || frame.empty() || frame == base_) return frames::Mounted{};
  const std::optional<frames::Mounted> found = frames_.find(base_, frame);
  if (!found) wait_for(frame, now_s);
  return found;
}

void SensorPlaces::wait_for(const std::string& frame, double now_s) {
  const bool is_one_too_many = waiting_since_s_.size() >= frames::StaticFrames::kMaxFrames;
  const double since_s = waiting_since_s_.try_emplace(frame, now_s).first->second;
  if (now_s - since_s < kKnownWithin_s && !is_one_too_many) return;
  const std::vector<std::string> known = frames_.names();
  const auto listed = std::min(std::ssize(known), kMaxFramesListed);
  throw std::runtime_error(
      fmt::format("{} where the frame \"{}\" is on \"{}\"{}; known are: {}{}",
                  topic_.empty() ? "`static_frames` is empty: nothing says" : topic_ + " does not say", frame, base_,
                  did_you_mean(frame, known),
                  known.empty() ? "none" : fmt::format("{}", fmt::join(known.begin(), known.begin() + listed, ", ")),
                  listed < std::ssize(known) ? ", ..." : ""));
}

}  // namespace cairn::ros
