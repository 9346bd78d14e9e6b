#include <gtest/gtest.h>

#include <thread>

#include "tests/planners/ompl/ompl_worlds.hpp"

namespace cairn {
namespace {

OmplPlanner planner_of(Algorithm algorithm) {
  OmplConfig config;
  config.algorithm = algorithm;
  config.iterations = 500;
  config.simplify = false;  // the raw answer shows every difference
  return OmplPlanner(config);
}

TEST(OmplDeterminism, SeveralThreadsAtOnceGetWhatOneGets) {
  const auto world = test::drawn_world(test::kOffice);
  for (const Algorithm algorithm :
       {Algorithm::rrt_connect, Algorithm::bit_star, Algorithm::prm, Algorithm::informed_rrt_star}) {
    const OmplPlanner planner = planner_of(algorithm);
    const auto path_for = [&](std::uint64_t seed) {
      PlanRequest request = world.request('A', 'B', 0.1);
      request.seed = seed;
      return planner.plan(request, world.view(), {}).path;
    };
    std::vector<std::vector<Pose2>> alone;
    for (std::uint64_t seed = 0; seed < 8; ++seed) alone.push_back(path_for(seed));

    std::vector<std::vector<Pose2>> together(8);
    std::vector<std::thread> threads;
    for (std::uint64_t seed = 0; seed < 8; ++seed) threads.emplace_back([&, seed] { together[seed] = path_for(seed); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(alone, together);
    EXPECT_NE(alone[1], alone[2]) << "the seed has no effect";
  }
}

TEST(OmplDeterminism, AWaitingCallHeedsItsCancelFlag) {
  const auto world = test::drawn_world(test::kOffice);
  OmplConfig config;
  config.algorithm = Algorithm::rrt_star;
  config.iterations = 1'000'000'000;
  const OmplPlanner planner(config);
  std::atomic<bool> cancel{false};
  Budget budget;
  budget.cancel = &cancel;
  std::vector<PlanOutcome> outcomes(3, PlanOutcome::solved);
  std::vector<std::thread> threads;
  for (PlanOutcome& outcome : outcomes)
    threads.emplace_back([&] { outcome = planner.plan(world.request('A', 'B', 0.1), world.view(), budget).outcome; });
  cancel = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(outcomes, std::vector<PlanOutcome>(3, PlanOutcome::cancelled));
}

}  // namespace
}  // namespace cairn
