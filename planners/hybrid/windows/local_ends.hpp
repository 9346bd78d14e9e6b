// The ends of a request on a large grid, found and joined to landmarks in windows of it.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "planners/common/disc_space/ends.hpp"
#include "planners/hybrid/symbolic_path.hpp"
#include "planners/hybrid/windows/windows.hpp"

namespace cairn {

struct NearGoal {
  std::size_t index = 0;  // among the goals
  double min_m = 0.0;     // no path there is shorter
};

class LocalEnds {
 public:
  // All must outlive it.
  LocalEnds(const WindowedGround& ground, const EndRules& rules, const WindowRules& windows, const Budget& budget)
      : ground_(ground), rules_(rules), windows_(windows), budget_(budget) {}

  // As start_of() and goals_of() say, but that a goal may turn out to be out of reach.
  [[nodiscard]] std::variant<StartPlace, Refusal> start(const Place& place) const;
  [[nodiscard]] std::variant<std::vector<GoalPlace>, Refusal> goals(const Place& place, const StartPlace& start) const;

  // The goal with the shortest path, of those so near the start.
  [[nodiscard]] std::optional<NearGoal> nearest(const StartPlace& start, const std::vector<GoalPlace>& goals,
                                                double within_m) const;

  [[nodiscard]] SymbolicEnd joined(const StartPlace& start) const;
  [[nodiscard]] SymbolicEnd joined(const std::vector<GoalPlace>& goals) const;

 private:
  [[nodiscard]] double disc_m() const { return rules_.radius_m + kMinRadius_m; }
  [[nodiscard]] bool has_routes(LandmarkId id) const;
  [[nodiscard]] WorldView part_round(const Point& p_map, std::shared_ptr<const Window>& window) const;
  void join(const Point& at, LandmarkId landmark, std::size_t goal, SymbolicEnd& end) const;

  const WindowedGround& ground_;
  const EndRules& rules_;
  const WindowRules& windows_;
  const Budget& budget_;
};

}  // namespace cairn
