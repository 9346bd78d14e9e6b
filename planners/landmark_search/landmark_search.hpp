// Shortest paths over the landmark graph (docs/method.md 9.4), exact on graphs of any size.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "framework/contracts/planner.hpp"
#include "planners/landmark_search/hierarchy_search.hpp"

namespace cairn {

// Ends are landmarks: from the best of `from` to the cheapest of `to`; ties go the same way every time.
// Closed routes are never used. A pose as an end is an unknown place to this planner. The result's path
// joins the stored trajectories, or the landmarks' standing places where there is none; it is not
// checked against the grid. cost_m is the sum of the routes' costs by length, whatever the ways are
// compared by. Uses the world's hierarchies, which must be up to date (std::logic_error when they lack an end);
// without them each call looks at the whole graph. Thread-safe.
class LandmarkSearch : public Planner {
 public:
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override;

 private:
  [[nodiscard]] std::unique_ptr<HierarchySearch> borrow() const;
  void give_back(std::unique_ptr<HierarchySearch> search) const;

  mutable std::mutex idle_lock_;
  mutable std::vector<std::unique_ptr<HierarchySearch>> idle_;  // space of searches that are done
};

}  // namespace cairn
