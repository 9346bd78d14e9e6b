// What has been heard of each topic: how often, how long ago, of which frames, by what clock.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/contracts/optional/connection_report.hpp"

namespace cairn::ros {

struct HeardTopic {
  std::uint64_t messages = 0;
  double first_s = 0.0;  // by a clock that does not step
  double last_s = 0.0;
  std::set<std::string> frames;   // kMaxFrames at most
  std::optional<double> ahead_s;  // the sender's clock of this computer's, less the time that messages take
};

class HeardTopics {
 public:
  static constexpr std::size_t kMaxFrames = 64;

  // A message without a header.
  void add(const std::string& topic, double arrived_s);
  // stamp_s: of its header; wall_s: when it came, by the clock that stamps should have.
  void add(const std::string& topic, double arrived_s, const std::string& frame, double stamp_s, double wall_s);

  // Null: nothing has come.
  [[nodiscard]] const HeardTopic* find(const std::string& topic) const;
  // Rate, age, frames and clock; "heard: nothing".
  [[nodiscard]] std::vector<ConnectionValue> values_of(const std::string& topic, double now_s) const;
  // Why readings by the stamps of a topic are not used beside the odometry of another; empty: they are, or it is not
  // known.
  [[nodiscard]] std::string clocks_apart(const std::string& topic, const std::string& odometry) const;

 private:
  std::map<std::string, HeardTopic> heard_;
};

}  // namespace cairn::ros
