// Shortest paths over the landmark graph (docs/method.md 9.4), exact on graphs of any size.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/route_planner.hpp"
#include "planners/landmark_search/boost_search.hpp"
#include "planners/landmark_search/hierarchy_search.hpp"

namespace cairn {

struct LandmarkSearchConfig {
  std::int64_t bidirectional_from = 2'000;  // measured: docs/results/graph.md
  static void describe(Fields<LandmarkSearchConfig>& fields) {
    fields.integer("bidirectional_from", &LandmarkSearchConfig::bidirectional_from, {0.0, 1e9},
                   "from this many landmarks on, the search goes from both ends; below, Boost.Graph's A* answers");
  }
};

// From the best of `from` to the cheapest of `to`; ties are resolved alike every time. Closed routes are never
// used. cost_m is the sum of the routes' costs by length, and of the ends' costs when these are lengths too. Uses the
// world's hierarchies, which must be up to date (std::logic_error when they lack an end); without them each call
// searches the whole graph. Boost.Graph's A* answers on graphs of fewer landmarks than the setting says, the search
// from both ends on larger ones. Thread-safe.
class LandmarkSearch : public RoutePlanner {
 public:
  explicit LandmarkSearch(LandmarkSearchConfig config = {}) : config_(config) {}
  [[nodiscard]] RouteResult plan(const RouteRequest& request, const WorldView& world,
                                 const Budget& budget) const override;

 private:
  // Space of searches, used again.
  struct Searches {
    BoostSearch boost;
    HierarchySearch bidirectional;
  };
  [[nodiscard]] std::unique_ptr<Searches> borrow() const;
  void give_back(std::unique_ptr<Searches> searches) const;
  [[nodiscard]] bool is_for_boost(const LandmarkGraph& graph) const;
  // Which search answers, and why.
  void name_search(const RouteRequest& request, const LandmarkGraph& graph, RouteExplanation& explanation) const;

  LandmarkSearchConfig config_;
  mutable std::mutex idle_lock_;
  mutable std::vector<std::unique_ptr<Searches>> idle_;
};

}  // namespace cairn
