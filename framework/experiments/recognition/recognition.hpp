// What a run has recognised of its world: a verdict on each thing that stands in it, and on each landmark
// that is not there.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/mission/events.hpp"
#include "framework/mission/mission.hpp"

namespace cairn {

// Notes how far the robot had driven when each landmark was first known.
class FirstKnown : public Listener {
 public:
  void on(const Event& event, const MissionView& view) override;
  // 0 for a landmark that it did not report.
  [[nodiscard]] double driven_m(LandmarkId id) const;

 private:
  std::optional<Point> last_m_;
  double driven_m_ = 0.0;
  std::map<LandmarkId, double> known_at_m_;
};

// A landmark found at a thing of the world.
struct FoundThing {
  double distance_m = 0.0;
  const Landmark* landmark = nullptr;
  const WorldObject* object = nullptr;
};
// Nearest first, each landmark and each thing once, no farther apart than tolerance_m; equally near ones in
// the order of landmarks and things.
[[nodiscard]] std::vector<FoundThing> pairs_within(const World& world, const LandmarkGraph& graph, double tolerance_m);

// One thing of the world, one landmark found, or both as a pair. Empty categories: truly no landmark, or
// none found.
struct Verdict {
  std::string is;
  std::string found;
  double position_error_m = 0.0;                // of a pair, as all below
  std::optional<double> orientation_error_rad;  // of the right category, modulo its symmetry; none when round
  double driven_m = 0.0;                        // until it was first known
  [[nodiscard]] bool is_right() const { return !is.empty() && is == found; }
};

// Landmarks and things are paired by pairs_within().
[[nodiscard]] std::vector<Verdict> judge_recognition(const Mission& mission, const LandmarkGraph& graph,
                                                     const FirstKnown& known, double tolerance_m);

}  // namespace cairn
