// A call that is cut off ends within 10 ms, whatever the algorithm and however the robot moves.
//
#include <gtest/gtest.h>

#include <algorithm>

#include "planners/ompl/ompl_planner.hpp"
#include "tests/planners/drawn_world.hpp"
#include "tests/planners/ompl/kind_cases.hpp"
#include "tests/planners/ompl/overrun.hpp"

namespace cairn {
namespace {

using Clock = Budget::Clock;
using test::KindCase;
using test::Overrun;
using test::overrun_of;

constexpr int kRuns = 3;
constexpr int kMaxRuns = 30;  // the least overshoot is judged: a run may be disturbed, a habit shows in all
constexpr auto kPromised = test::kSlowdown * std::chrono::milliseconds(10);

// 200 x 200 cells: corridors two metres wide, one after another, with a post in the middle of each.
test::DrawnWorld winding_world() {
  constexpr int kSide = 200;
  constexpr int kPitch = 20;
  test::DrawnWorld world;
  const auto is_wall = [](int x, int y) {
    if (x == 0 || y == 0 || x == kSide - 1 || y == kSide - 1) return true;
    const int corridor = y / kPitch;
    const bool open = corridor % 2 == 0 ? x > kSide - kPitch : x < kPitch;
    if (y % kPitch == kPitch - 1 && !open) return true;
    return y % kPitch == kPitch / 2 && x % 40 == kPitch && x > kPitch && x < kSide - kPitch;
  };
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) world.grid.set_log_odds({x, y}, is_wall(x, y) ? 900 : -900);
  world.places['A'] = {1.05, 0.65};
  world.places['B'] = {1.05, 19.05};
  return world;
}

class InTime : public ::testing::TestWithParam<KindCase> {
 protected:
  static void SetUpTestSuite() { world_ = std::make_unique<test::DrawnWorld>(winding_world()); }
  static void TearDownTestSuite() { world_.reset(); }

  [[nodiscard]] static OmplPlanner planner() {
    OmplConfig config;
    config.algorithm = GetParam().algorithm;
    config.kinematics = GetParam().kind;
    config.turning_radius_m = 0.5;
    config.improve_iterations = 0;
    return OmplPlanner(config);
  }
  // Warm: what is kept from call to call is there.
  static PathResult plan(const OmplPlanner& planner, const Budget& budget, std::uint64_t seed) {
    PathRequest request = world_->request('A', 'B', 0.2);
    request.seed = seed;
    return planner.plan(request, world_->view(), budget);
  }
  static void warm_up(const OmplPlanner& planner) {
    planner.prepare(world_->view(), 0.2);
    Budget budget;
    budget.deadline = Clock::now() + std::chrono::milliseconds(20);
    (void)plan(planner, budget, 1);
  }

  static std::unique_ptr<test::DrawnWorld> world_;
};
std::unique_ptr<test::DrawnWorld> InTime::world_;

TEST_P(InTime, ADeadlineHolds) {
  const OmplPlanner planner = this->planner();
  warm_up(planner);
  for (const auto given : {std::chrono::milliseconds(5), std::chrono::milliseconds(60)}) {
    auto least = Clock::duration::max();
    for (int run = 0; run < kMaxRuns && (run < kRuns || least > kPromised); ++run) {
      Budget budget;
      budget.deadline = Clock::now() + given;
      const Overrun run_of = overrun_of(
          budget.deadline, [&] { return plan(planner, budget, 10 + run); }, [] {});
      if (run_of.late <= test::kMaxLate) least = std::min(least, run_of.over + run_of.late);
      const PathResult& result = run_of.result;
      EXPECT_TRUE(result.outcome == PlanOutcome::solved || result.outcome == PlanOutcome::out_of_budget)
          << name_of(result.outcome) << ": " << result.reason;
    }
    if (least == Clock::duration::max()) GTEST_SKIP() << "the machine is too busy to measure it";
    EXPECT_LE(least, kPromised) << given.count() << " ms given";
  }
}

TEST_P(InTime, ACancelHolds) {
  const OmplPlanner planner = this->planner();
  warm_up(planner);
  auto least = Clock::duration::max();
  for (int run = 0; run < kMaxRuns && (run < kRuns || least > kPromised); ++run) {
    std::atomic<bool> cancel{false};
    Budget budget;
    budget.cancel = &cancel;
    // However late the flag is set, the work after it counts from then on.
    const Overrun run_of = overrun_of(
        Clock::now() + std::chrono::milliseconds(5), [&] { return plan(planner, budget, 10 + run); },
        [&] { cancel = true; });
    least = std::min(least, run_of.over);
    // What was found by then may be answered; and a flag that comes late, on a busy machine, finds a search that has
    // used up its iterations: such a call had ended before it.
    const PathResult& result = run_of.result;
    const bool ended_before = result.outcome == PlanOutcome::out_of_budget && run_of.over == Clock::duration::zero();
    EXPECT_TRUE(ended_before || result.outcome == PlanOutcome::cancelled || result.outcome == PlanOutcome::solved)
        << name_of(result.outcome) << ": " << result.reason;
  }
  EXPECT_LE(least, kPromised);
}

INSTANTIATE_TEST_SUITE_P(Ompl, InTime, ::testing::ValuesIn(test::every_kind_case()),
                         [](const auto& instance) { return name_of(instance.param); });

}  // namespace
}  // namespace cairn
