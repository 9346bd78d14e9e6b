// Shortest paths over the landmark graph (docs/method.md 9.4), exact on graphs of any size.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "framework/contracts/route_planner.hpp"
#include "planners/landmark_search/hierarchy_search.hpp"

namespace cairn {

// From the best of `from` to the cheapest of `to`; ties are resolved alike every time. Closed routes are never
// used. cost_m is the sum of the routes' costs by length, and of the ends' costs when these are lengths too. Uses the
// world's hierarchies, which must be up to date (std::logic_error when they lack an end); without them each call
// searches the whole graph. Thread-safe.
class LandmarkSearch : public RoutePlanner {
 public:
  [[nodiscard]] RouteResult plan(const RouteRequest& request, const WorldView& world,
                                 const Budget& budget) const override;

 private:
  [[nodiscard]] std::unique_ptr<HierarchySearch> borrow() const;
  void give_back(std::unique_ptr<HierarchySearch> search) const;

  mutable std::mutex idle_lock_;
  mutable std::vector<std::unique_ptr<HierarchySearch>> idle_;  // space of searches that are done
};

}  // namespace cairn
