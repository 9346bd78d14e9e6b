// What routes are counted by, and what more iterations and more time are worth.

#include <gtest/gtest.h>

#include <random>

#include "planners/common/disc_space/routes.hpp"
#include "tests/planners/ompl/ompl_worlds.hpp"
#include "tests/planners/ompl/overrun.hpp"

namespace cairn {
namespace {

constexpr double kRadius_m = 0.1;
constexpr double kWide_m = 0.45;  // in a drawing whose blocks are 0.4 m

// Straight on through a passage of three cells, or round over open ground.
const char* const kTightOrWide =
    "########################\n"
    "#......................#\n"
    "#......................#\n"
    "#......................#\n"
    "#......................#\n"
    "#......................#\n"
    "#.....############.....#\n"
    "#.....############.....#\n"
    "#......................#\n"
    "#..A................B..#\n"
    "#......................#\n"
    "#.....############.....#\n"
    "########################\n";

OmplConfig by(Objective objective) {
  OmplConfig config;
  config.objective = objective;
  return config;
}

PathResult plan(const test::DrawnWorld& world, const PathRequest& request, const OmplConfig& config) {
  return OmplPlanner(config).plan(request, world.view(), {});
}

// Of a path, counted anew.
double counted(const test::DrawnWorld& world, const std::vector<Pose2>& path, const TravelCostRules& rules,
               UnknownPolicy unknown = UnknownPolicy::avoid) {
  GroundRules ground;
  ground.unknown = unknown;
  const DiscSpace space(world.grid, ground);
  const TravelCost cost(world.grid, space, rules);
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += cost.between(path[i - 1].position(), path[i].position());
  return sum;
}

TravelCostRules clearance_rules(double radius_m = kRadius_m) {
  TravelCostRules rules;
  rules.objective = Objective::clearance;
  rules.radius_m = radius_m;
  return rules;
}

test::DrawnWorld room_with_boxes(std::uint64_t seed) {
  constexpr int kSide = 50;
  std::mt19937_64 random(seed);
  test::DrawnWorld world;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) world.grid.set_log_odds({x, y}, LogOdds{-900});
  for (int box = 0; box < 14; ++box) {
    const Cell low{4 + static_cast<int>(random() % 38), 4 + static_cast<int>(random() % 38)};
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 4; ++x) world.grid.set_log_odds(low + Cell{x, y}, LogOdds{900});
  }
  world.places['A'] = {0.25, 0.25};
  world.places['B'] = {4.75, 4.75};
  return world;
}

TEST(Objectives, ClearanceGoesRoundWhereLengthSqueezesThrough) {
  const auto world = test::drawn_world(kTightOrWide, 0.1, 4);
  const PathRequest request = world.request('A', 'B', kWide_m);
  const PathResult shortest = plan(world, request, by(Objective::length));
  const PathResult clearest = plan(world, request, by(Objective::clearance));
  ASSERT_EQ(shortest.outcome, PlanOutcome::solved);
  ASSERT_EQ(clearest.outcome, PlanOutcome::solved);
  EXPECT_GT(clearest.clearance_m, shortest.clearance_m + 0.04) << test::drawing_of(world.grid, clearest.path);
  EXPECT_GT(clearest.length_m, shortest.length_m + 0.2);
  EXPECT_LT(counted(world, clearest.path, clearance_rules(kWide_m)),
            counted(world, shortest.path, clearance_rules(kWide_m)));
  EXPECT_TRUE(test::keeps_clear(world.grid, clearest.path, kWide_m));
}

TEST(Objectives, WeightedMovesBetweenThemWithItsWeight) {
  const auto world = test::drawn_world(kTightOrWide, 0.1, 4);
  const PathRequest request = world.request('A', 'B', kWide_m);
  double length_before_m = 0.0;
  double room_before = std::numeric_limits<double>::infinity();
  for (const double weight : {0.0, 0.3, 3.0, 100.0}) {
    OmplConfig config = by(Objective::weighted);
    config.time_weight = 0.0;
    config.clearance_weight = weight;
    const PathResult result = plan(world, request, config);
    ASSERT_EQ(result.outcome, PlanOutcome::solved);
    const double room = counted(world, result.path, clearance_rules(kWide_m)) - result.length_m;
    EXPECT_GE(result.length_m, length_before_m * 0.999) << "weight " << weight;
    EXPECT_LE(room, room_before * 1.01) << "weight " << weight;
    length_before_m = result.length_m;
    room_before = room;
  }
  EXPECT_NEAR(plan(world, request, by(Objective::length)).length_m,
              world.request('A', 'B', kWide_m).to.pose->x_m - world.request('A', 'B', kWide_m).from.pose->x_m, 1e-9);
}

TEST(Objectives, TimeGoesAsStraightAsLength) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto world = room_with_boxes(seed);
    const PathRequest request = world.request('A', 'B', kRadius_m);
    const PathResult shortest = plan(world, request, by(Objective::length));
    const PathResult fastest = plan(world, request, by(Objective::time));
    ASSERT_EQ(shortest.outcome, fastest.outcome);
    if (shortest.outcome != PlanOutcome::solved) continue;
    EXPECT_LE(fastest.length_m, shortest.length_m * 1.01);
  }
}

// A strip of unknown ground: across it a metre counts as often as it is set to.
TEST(Objectives, UnknownGroundIsCrossedOnlyWhereItSavesEnough) {
  const auto world = test::drawn_world(
      "##############################\n"
      "#............................#\n"
      "#.#####################.#####.\n"
      "#............????............#\n"
      "#..A.........????.........B..#\n"
      "#............????............#\n"
      "##############################\n");
  const PathRequest request = world.request('A', 'B', 0.04);
  OmplConfig config;
  config.unknown = UnknownGround::cost;
  const auto crosses = [&](double weight) {
    config.unknown_weight = weight;
    const PathResult result = plan(world, request, config);
    EXPECT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
    double unknown_m = 0.0;
    for (std::size_t i = 1; i < result.path.size(); ++i)
      for (int k = 0; k < 1000; ++k) {
        const Point step = result.path[i].position() - result.path[i - 1].position();
        const Point p = result.path[i - 1].position() + step * ((k + 0.5) / 1000);
        if (world.grid.state(world.grid.cell_at(p)) == CellState::unknown) unknown_m += step.norm() / 1000;
      }
    return unknown_m > 0.01;
  };
  EXPECT_TRUE(crosses(1.0));
  EXPECT_TRUE(crosses(1.5));
  EXPECT_FALSE(crosses(30.0));
}

TEST(Objectives, NoCostIsWorseThanThatOfThePlainRouteAndMoreIterationsNeverMakeItWorse) {
  int better = 0;
  for (const Objective objective : {Objective::length, Objective::clearance})
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const auto world = room_with_boxes(seed);
      const PathRequest request = world.request('A', 'B', kRadius_m);
      OmplConfig config = by(objective);
      config.good_enough_ratio = 1.0;
      config.improve_iterations = 0;  // no deadline: no improvement
      const auto cost_after = [&](std::int64_t iterations) {
        config.improve_iterations = iterations;
        return plan(world, request, config).cost_m;
      };
      if (plan(world, request, config).outcome != PlanOutcome::solved) continue;
      const DiscRoutes routes(std::make_shared<const DiscSpace>(world.grid, GroundRules{}), kRadius_m + kMinRadius_m);
      std::vector<Pose2> plain;
      for (const Point& p : routes.route(world.places.at('A'), world.places.at('B'), {}).route)
        plain.push_back({p.x(), p.y(), 0.0});
      double before = objective == Objective::length ? length_of(plain) : counted(world, plain, clearance_rules());
      const double at_first = before;
      for (const std::int64_t iterations : {0, 25, 50, 100, 200, 400, 800}) {
        const double cost = cost_after(iterations);
        EXPECT_LE(cost, at_first * (1.0 + 1e-9)) << "seed " << seed << ", " << iterations << " iterations";
        EXPECT_LE(cost, before * (1.0 + 1e-9)) << "seed " << seed << ", " << iterations << " iterations";
        before = cost;
      }
      better += before < at_first * 0.999;
    }
  EXPECT_GT(better, 3);
}

// Until the deadline, and with what that has brought: judged by the best of several runs.
TEST(Objectives, WithoutACountImprovementLastsUntilTheDeadline) {
  const auto world = room_with_boxes(2);
  const PathRequest request = world.request('A', 'B', kRadius_m);
  OmplConfig config = by(Objective::clearance);
  config.improve_iterations = 0;
  const OmplPlanner planner(config);
  const PathResult plain = planner.plan(request, world.view(), {});
  ASSERT_EQ(plain.outcome, PlanOutcome::solved) << plain.reason;
  auto least = Budget::Clock::duration::max();
  for (int run = 0; run < 4; ++run) {
    Budget budget;
    budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(60);
    const test::Overrun run_of = test::overrun_of(
        budget.deadline, [&] { return planner.plan(request, world.view(), budget); }, [] {});
    EXPECT_GE(Budget::Clock::now(), budget.deadline) << "it stopped before";
    if (run_of.late <= test::kMaxLate) least = std::min(least, run_of.over + run_of.late);
    ASSERT_EQ(run_of.result.outcome, PlanOutcome::solved);
    EXPECT_LE(run_of.result.cost_m, plain.cost_m * (1.0 + 1e-9));
  }
  if (least == Budget::Clock::duration::max()) GTEST_SKIP() << "the machine is too busy to measure it";
  EXPECT_LE(least, test::kSlowdown * std::chrono::milliseconds(10));
}

}  // namespace
}  // namespace cairn
