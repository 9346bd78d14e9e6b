// Where the robot was at every moment of a log.
#pragma once

#include <optional>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "plugins/mcap_log/bag.hpp"

namespace cairn::mcap_log {

class PoseTrack {
 public:
  void add(const Moment& at, const Pose2& pose) { known_.push_back({at, pose}); }
  // When all are there. Logarithmic from then on.
  void sort();
  [[nodiscard]] bool is_empty() const { return known_.empty(); }
  // Between the two around it, or the nearest at the ends of the log and of a part of it. None: none is known.
  [[nodiscard]] std::optional<Pose2> at(const Moment& moment) const;

 private:
  struct Known {
    Moment at;
    Pose2 pose;
  };
  std::vector<Known> known_;
};

// The clock jumps where a stamp is more than a second before the latest so far in the file: from there on it is another
// part. Messages of several topics that come in another order than their stamps stay in one.
void number_parts(std::vector<Moment*> moments);

}  // namespace cairn::mcap_log
