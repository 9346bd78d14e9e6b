#include "plugins/mcap_log/pose_track.hpp"

#include <algorithm>
#include <limits>

namespace cairn::mcap_log {

void PoseTrack::sort() {
  std::ranges::stable_sort(known_, [](const Known& a, const Known& b) { return a.at < b.at; });
}

std::optional<Pose2> PoseTrack::at(const Moment& moment) const {
  if (known_.empty()) return std::nullopt;
  const auto after =
      std::lower_bound(known_.begin(), known_.end(), moment, [](const Known& a, const Moment& b) { return a.at < b; });
  if (after == known_.begin()) return after->pose;
  const Known& before = *std::prev(after);
  if (after == known_.end()) return before.pose;
  if (before.at.part != after->at.part) return after->at.part == moment.part ? after->pose : before.pose;
  const double ratio = (moment.stamp_s - before.at.stamp_s) / (after->at.stamp_s - before.at.stamp_s);
  if (ratio >= 1.0) return after->pose;
  const Pose2 step = inverse(before.pose) * after->pose;
  return before.pose * Pose2{ratio * step.x_m, ratio * step.y_m, ratio * step.theta_rad};
}

void number_parts(std::vector<Moment*> moments) {
  constexpr double kLate_s = 1.0;
  std::ranges::stable_sort(moments, {}, [](const Moment* moment) { return moment->order; });
  int part = 0;
  double latest_s = -std::numeric_limits<double>::infinity();
  for (Moment* const moment : moments) {
    if (moment->stamp_s < latest_s - kLate_s) {
      ++part;
      latest_s = moment->stamp_s;
    }
    latest_s = std::max(latest_s, moment->stamp_s);
    moment->part = part;
  }
}

}  // namespace cairn::mcap_log
