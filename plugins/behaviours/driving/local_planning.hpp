// Paths on the local map, for where the planner finds none: first on the map as it is, then more and more optimistic
// about it, and out of a place that is too near to something.
#pragma once

#include <optional>
#include <vector>

#include "plugins/behaviours/driving/blockage_look.hpp"
#include "plugins/behaviours/local_map/local_map.hpp"

namespace cairn::behaviours {

struct OptimismSettings {
  int max_escapes = 4;
  int max_unknown_paths = 20;
  int max_narrow_gap_tries = 3;
  int looks_before_narrow_gaps = 2;
  double narrow_gap_radius_m = 0.16;
  static void describe(Fields<OptimismSettings>& fields);
};

struct LocalPath {
  std::vector<Point> points;
  Optimism optimism = Optimism::none;
};

class LocalPlanning {
 public:
  explicit LocalPlanning(const OptimismSettings& settings = {}) : settings_(settings) {}

  // With this much optimism.
  [[nodiscard]] std::optional<LocalPath> path(const Point& goal, Optimism optimism, const WorldView& world,
                                              const LocalMap& map, const BlockageLook& look) const;
  // With as little optimism as there is a path for; each kind a few times only. The narrow gaps come after some looks.
  [[nodiscard]] std::optional<LocalPath> next_path(const Point& goal, const WorldView& world, const LocalMap& map,
                                                   const BlockageLook& look);
  // To the nearest place with room; none when there is none near, or after too many.
  [[nodiscard]] std::optional<std::vector<Point>> escape(const Point& goal, const WorldView& world, const LocalMap& map,
                                                         const BlockageLook& look);
  [[nodiscard]] int escapes() const { return escapes_; }

 private:
  OptimismSettings settings_;
  int escapes_ = 0;
  int unknown_paths_ = 0;
  int narrow_gap_tries_ = 0;
};

}  // namespace cairn::behaviours
