#include "plugins/common/ros/heard_topics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace cairn::ros {
namespace {

constexpr double kOtherTime_s = 1e7;  // a clock that is so far off is simulated, or was never set
constexpr double kMaxBehind_s = 1.0;  // as readings are kept beside the odometry
constexpr double kMaxAhead_s = 0.3;
constexpr std::size_t kMaxFramesShown = 4;

std::string clock_text(double ahead_s) {
  if (std::abs(ahead_s) > kOtherTime_s) return "simulated, or never set";
  return fmt::format("{:+.3f} s of this computer's", ahead_s);
}

std::string frames_text(const std::set<std::string>& frames) {
  const auto listed = std::min(frames.size(), kMaxFramesShown);
  return fmt::format("{}{}",
                     fmt::join(frames.begin(), std::next(frames.begin(), static_cast<std::ptrdiff_t>(listed)), " "),
                     frames.size() > listed ? fmt::format(" and {} more", frames.size() - listed) : "");
}

}  // namespace

void HeardTopics::add(const std::string& topic, double arrived_s) {
  HeardTopic& heard = heard_[topic];
  if (heard.messages++ == 0) heard.first_s = arrived_s;
  heard.last_s = arrived_s;
}

void HeardTopics::add(const std::string& topic, double arrived_s, const std::string& frame, double stamp_s,
                      double wall_s) {
  add(topic, arrived_s);
  HeardTopic& heard = heard_[topic];
  if (!frame.empty() && heard.frames.size() < kMaxFrames) heard.frames.insert(frame);
  heard.ahead_s = std::max(heard.ahead_s.value_or(stamp_s - wall_s), stamp_s - wall_s);
}

const HeardTopic* HeardTopics::find(const std::string& topic) const {
  const auto found = heard_.find(topic);
  return found == heard_.end() ? nullptr : &found->second;
}

std::vector<ConnectionValue> HeardTopics::values_of(const std::string& topic, double now_s) const {
  const HeardTopic* const heard = find(topic);
  if (heard == nullptr) return {{"heard", "nothing"}};
  std::vector<ConnectionValue> values;
  if (heard->messages > 1 && heard->last_s > heard->first_s)
    values.push_back({"rate", fmt::format("{:.1f} a second", static_cast<double>(heard->messages - 1) /
                                                                 (heard->last_s - heard->first_s))});
  values.push_back({"age", fmt::format("{:.2f} s", now_s - heard->last_s)});
  if (!heard->frames.empty()) values.push_back({"frame", frames_text(heard->frames)});
  if (heard->ahead_s) values.push_back({"clock", clock_text(*heard->ahead_s)});
  return values;
}

std::string HeardTopics::clocks_apart(const std::string& topic, const std::string& odometry) const {
  const HeardTopic* const readings = find(topic);
  const HeardTopic* const base = find(odometry);
  if (readings == nullptr || base == nullptr || !readings->ahead_s || !base->ahead_s) return {};
  const double ahead_s = *readings->ahead_s - *base->ahead_s;
  if (ahead_s >= -kMaxBehind_s && ahead_s <= kMaxAhead_s) return {};
  return fmt::format(
      "its stamps are {:.2f} s {} those of {}, and such readings are not used: set its clock, or say `stamp: arrival`",
      std::abs(ahead_s), ahead_s < 0.0 ? "behind" : "ahead of", odometry);
}

}  // namespace cairn::ros
