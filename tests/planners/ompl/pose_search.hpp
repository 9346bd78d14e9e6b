// One plain search by an OMPL planner for a robot with an outline, as tests of planners and spaces share it.
#pragma once

#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "planners/ompl/pose/kinematic_spaces.hpp"
#include "planners/ompl/search/algorithm_factory.hpp"
#include "tests/planners/drawn_world.hpp"

namespace cairn::test {

inline constexpr const char* kRoomWithBox =
    "########################\n"
    "#......................#\n"
    "#......................#\n"
    "#..........###.........#\n"
    "#..A.......###.....B...#\n"
    "#..........###.........#\n"
    "#..........###.........#\n"
    "#......................#\n"
    "#......................#\n"
    "########################\n";

struct PoseSearch {
  DrawnWorld world = drawn_world(kRoomWithBox, 0.1, 2);
  DiscSpace ground{world.grid, {}};
  PoseSpace poses{ground, Footprint::polygon({{-0.1, -0.12}, {0.3, -0.12}, {0.3, 0.12}, {-0.1, 0.12}}), 0.01};
  PoseDraw draw;
  KinematicRules rules;
  Pose2 from = world.pose('A');
  Pose2 to = world.pose('B');

  explicit PoseSearch(MotionKind kind) {
    rules.kind = kind;
    rules.turning_radius_m = 0.4;
    const CellBox box = world.grid.bounds();
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x)
        if (!ground.is_blocked({x, y})) draw.cells.add({{x, y}, {x + 1, y + 1}});
  }

  // The poses of an exact path; empty when there is none.
  [[nodiscard]] std::vector<Pose2> run(Algorithm algorithm, std::uint64_t seed, std::int64_t iterations) const {
    namespace ob = ompl::base;
    ompl::msg::noOutputHandler();
    ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(seed));
    const auto info = kinematic_information(rules, poses, draw, seed);
    auto problem = std::make_shared<ob::ProblemDefinition>(info);
    ob::ScopedState<> start(info);
    ob::ScopedState<> goal(info);
    set_pose(start.get(), from);
    set_pose(goal.get(), to);
    problem->setStartAndGoalStates(start, goal);
    problem->setOptimizationObjective(std::make_shared<ob::PathLengthOptimizationObjective>(info));
    const ob::PlannerPtr planner = make_algorithm(algorithm, info);
    planner->setProblemDefinition(problem);
    planner->setup();
    std::int64_t asked = 0;
    planner->solve(ob::PlannerTerminationCondition([&] { return ++asked > iterations; }));
    std::vector<Pose2> path;
    if (!problem->hasExactSolution()) return path;
    for (const ob::State* state : static_cast<ompl::geometric::PathGeometric&>(*problem->getSolutionPath()).getStates())
      path.push_back(pose_of(state));
    return path;
  }

  [[nodiscard]] std::vector<Motion> motions_of(const std::vector<Pose2>& path) const {
    const auto space = make_kinematic_space(rules, ground.field());
    std::vector<Motion> motions;
    for (std::size_t i = 1; i < path.size(); ++i) motions.push_back(motion_between(*space, path[i - 1], path[i]));
    return motions;
  }
};

}  // namespace cairn::test
