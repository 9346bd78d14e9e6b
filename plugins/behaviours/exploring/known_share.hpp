// How much of what the robot can reach is known.
//
// Counted in places for the robot's centre: those that it gets to on the map as it is, against these and what may lie
// behind: unknown places that it may get to from there, no farther than a room is deep, and a strip behind every edge
// that it has not been near to, since walls that were seen from afar hide doors. What is outside of a closed outline
// counts for nothing, so the share is right in rooms of any outline. It never falls: a rise counts once it has held for
// some counts, since noise closes a door for a moment.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "plugins/behaviours/local_map/cell_layer.hpp"
#include "plugins/behaviours/local_map/free_space.hpp"

namespace cairn::behaviours {

struct KnownShareSettings {
  double every_s = 4.0;
  double rim_m = 1.0;
  double behind_m = 3.0;
  double behind_edges_m = 0.5;
  double closed_radius_m = 0.45;
  int held_counts = 3;
  static void describe(Fields<KnownShareSettings>& fields);
};

class KnownShare {
 public:
  explicit KnownShare(const KnownShareSettings& settings = {}) : settings_(settings) {}

  [[nodiscard]] bool is_due(double time_s) const { return time_s >= counted_s_ + settings_.every_s; }
  // reach: as reach_of() of the space. unseen_edges: cells. gap_radius_m: unknown places behind a gap twice this wide
  // count. closed: what was looked at and found closed, for the robot. hidden_m2: what echoes have shown behind walls.
  // O(cells).
  void count(const FreeSpace& space, const CellLayer<char>& reach, std::size_t unseen_edges, double gap_radius_m,
             double time_s, const std::vector<Point>& closed = {}, double hidden_m2 = 0.0);
  // Nothing changes any more: the last count holds.
  void settle() {
    if (!last_.empty()) ratio_ = std::max(ratio_, last_.back());
  }
  // 0 before the first count that has held.
  [[nodiscard]] double ratio() const { return ratio_; }

 private:
  KnownShareSettings settings_;
  double counted_s_ = -1e9;
  std::vector<double> last_;  // counts, the newest last
  double ratio_ = 0.0;
};

}  // namespace cairn::behaviours
