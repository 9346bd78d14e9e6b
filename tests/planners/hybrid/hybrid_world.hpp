// Two rooms joined by two corridors, with whatever landmarks and routes a test adds, and a hybrid planner in it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "planners/hybrid/hybrid_planner.hpp"
#include "planners/landmark_search/landmark_search.hpp"
#include "planners/ompl/ompl_planner.hpp"
#include "tests/planners/drawn_world.hpp"

namespace cairn::test {

inline constexpr double kRadius_m = 0.14;

// Count what they pass on.
class CountingPathPlanner : public PathPlanner {
 public:
  explicit CountingPathPlanner(std::shared_ptr<const PathPlanner> inner) : inner_(std::move(inner)) {}
  PlannerTraits traits() const override { return inner_->traits(); }
  PathResult plan(const PathRequest& request, const WorldView& world, const Budget& budget) const override {
    ++calls;
    return inner_->plan(request, world, budget);
  }
  mutable int calls = 0;

 private:
  std::shared_ptr<const PathPlanner> inner_;
};

class CountingRoutePlanner : public RoutePlanner {
 public:
  explicit CountingRoutePlanner(std::shared_ptr<const RoutePlanner> inner) : inner_(std::move(inner)) {}
  RouteResult plan(const RouteRequest& request, const WorldView& world, const Budget& budget) const override {
    ++calls;
    return inner_->plan(request, world, budget);
  }
  mutable int calls = 0;

 private:
  std::shared_ptr<const RoutePlanner> inner_;
};

[[nodiscard]] inline std::shared_ptr<CountingPathPlanner> counted_ompl(const OmplConfig& config = {}) {
  return std::make_shared<CountingPathPlanner>(std::make_shared<OmplPlanner>(config));
}

class Hybrid : public ::testing::Test {
 protected:
  // Two corridors join the left room to the right one.
  DrawnWorld world = drawn_world(
      "############################\n"
      "#......##############......#\n"
      "#......##############......#\n"
      "#......##############......#\n"
      "#......##############......#\n"
      "#..........................#\n"
      "#.A....M........U...N....B.#\n"
      "#..........................#\n"
      "#..........................#\n"
      "#......##############......#\n"
      "#......##############......#\n"
      "#......##############......#\n"
      "#..........................#\n"
      "#.C....P........V...Q....D.#\n"
      "#..........................#\n"
      "#..........................#\n"
      "############################\n");
  HybridConfig config;
  std::shared_ptr<CountingPathPlanner> router = counted_ompl();
  std::shared_ptr<CountingRoutePlanner> searcher =
      std::make_shared<CountingRoutePlanner>(std::make_shared<LandmarkSearch>());

  LandmarkId landmark(char place) {
    Landmark landmark;
    landmark.name = std::string(1, place);
    landmark.T_map_landmark = world.pose(place);
    landmark.access = world.pose(place);
    return world.graph.add(landmark);
  }
  RouteId route(LandmarkId from, LandmarkId to, const std::string& places, double cost_m = -1.0) {
    Route route;
    route.from = from;
    route.to = to;
    for (const char place : places) route.trajectory.push_back(world.pose(place));
    const Point straight =
        world.graph.find(to)->T_map_landmark.position() - world.graph.find(from)->T_map_landmark.position();
    route.cost_m = cost_m >= 0.0 ? cost_m : route.trajectory.empty() ? straight.norm() : length_of(route.trajectory);
    return world.graph.add_route(route);
  }
  PlanResult plan(const PlanRequest& request, const Budget& budget = {}) const {
    return HybridPlanner(config, router, searcher).plan(request, world.view(), budget);
  }
  // A wall right across the corridor, where the letter stands.
  void block(char place) {
    for (int dy = -2; dy <= 3; ++dy)
      world.grid.set_log_odds(world.grid.cell_at(world.places.at(place)) + Cell{0, dy}, 900);
  }
  PlanRequest request(char from, char to) const {
    PlanRequest request;
    request.from.pose = world.pose(from);
    request.to.pose = world.pose(to);
    request.radius_m = kRadius_m;
    return request;
  }
  static PlanRequest between(LandmarkId from, LandmarkId to) {
    PlanRequest request;
    request.from.landmarks = {from};
    request.to.landmarks = {to};
    request.radius_m = kRadius_m;
    return request;
  }
  void expect_clear(const PlanResult& result) const {
    EXPECT_GE(distance_by_brute_force(world.grid, result.path, false, 0.01), kRadius_m - 1e-9)
        << drawing_of(world.grid, result.path);
    EXPECT_NEAR(result.length_m, length_of(result.path), 1e-9);
    expect_segments_add_up(result);
  }
  static void expect_segments_add_up(const PlanResult& result) {
    double segments_m = 0.0;
    for (const PathSegment& piece : result.segments) segments_m += piece.length_m;
    EXPECT_NEAR(segments_m, result.length_m, 1e-9);
  }
};

}  // namespace cairn::test
