// Answers one request for a disc.
#pragma once

#include "planners/common/disc_space/ends.hpp"
#include "planners/ompl/ompl_planner.hpp"

namespace cairn {

// What the planner brings to every request.
struct OmplTools {
  const OmplConfig& config;
  const AlgorithmParameters& parameters;
  const OmplCaches& caches;
};

[[nodiscard]] EndRules end_rules_of(const OmplConfig& config, double radius_m);
[[nodiscard]] TravelCostRules cost_rules_of(const OmplConfig& config, const PathRequest& request,
                                            const WorldView& world, double radius_m);

// A route and how it was found.
struct FoundRoute {
  std::vector<Point> route;  // from StartPlace::leave_from; empty: none
  bool exact = false;        // otherwise it ends short of the goal
  bool interrupted = false;
  bool impossible = false;  // proven
  std::optional<double> length_lower_bound_m;
  std::string how;
};

class DiscQuery {
 public:
  // Borrows all of it.
  DiscQuery(const OmplTools& tools, const PathRequest& request, const WorldView& world, const Budget& budget);

  [[nodiscard]] PathResult answer() const;

 private:
  [[nodiscard]] PathResult answer_from(const StartPlace& start) const;
  [[nodiscard]] FoundRoute find(const StartPlace& start, const GoalPlace& goal, const DiscRoutes& routes) const;
  [[nodiscard]] FoundRoute find_on_grid(const DiscRoutes& routes, const TravelCost& cost, const Point& from,
                                        const Point& to) const;
  [[nodiscard]] FoundRoute find_by_sampling(const DiscRoutes& routes, const TravelCost& cost, const Point& from,
                                            const Point& to) const;
  [[nodiscard]] std::vector<Point> shortened(const DiscRoutes& routes, const TravelCost& cost,
                                             const std::vector<Point>& route) const;
  void improve(FoundRoute& found, const DiscRoutes& routes, const TravelCost& cost) const;
  [[nodiscard]] PathResult checked(const StartPlace& start, const GoalPlace& goal, const FoundRoute& found) const;
  [[nodiscard]] PathResult result_of(const StartPlace& start, const GoalPlace& goal, const FoundRoute& found,
                                     const std::vector<Point>& route, const TravelCost& cost) const;
  [[nodiscard]] double radius_m() const;

  OmplTools tools_;
  const PathRequest& request_;
  const WorldView& world_;
  const Budget& budget_;
  EndRules rules_;
};

}  // namespace cairn
