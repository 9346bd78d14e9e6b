#include <gtest/gtest.h>

#include <cstring>
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
      PathRequest request = world.request('A', 'B', 0.1);
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

// Byte for byte, from four threads with two queries each.
TEST(OmplDeterminism, HoweverTheRobotMovesThreadsChangeNothing) {
  const auto world = test::drawn_world(test::kOffice);
  std::size_t found = 0;  // few draws do not get every algorithm there
  for (const MotionKind kind :
       {MotionKind::holonomic, MotionKind::differential, MotionKind::dubins, MotionKind::reeds_shepp})
    for (const Algorithm algorithm :
         {Algorithm::any_angle_rrt_star, Algorithm::rrt, Algorithm::bit_star, Algorithm::kpiece}) {
      OmplConfig config;
      config.algorithm = algorithm;
      config.kinematics = kind;
      config.turning_radius_m = 0.15;
      config.iterations = 300;
      config.improve_iterations = 20;
      config.good_enough_ratio = 1.0;
      const OmplPlanner planner(config);
      constexpr std::pair<char, char> kEnds[] = {{'A', 'B'}, {'B', 'C'}, {'C', 'D'}, {'D', 'A'}};
      const auto path_of = [&](const OmplPlanner& by, std::size_t query) {
        PathRequest request = world.request(kEnds[query % 4].first, kEnds[query % 4].second, 0.1);
        request.seed = query;
        return by.plan(request, world.view(), {}).path;
      };
      std::vector<std::vector<Pose2>> alone;
      for (std::size_t query = 0; query < 8; ++query) {
        alone.push_back(path_of(planner, query));
        found += alone.back().empty() ? 0 : 1;
      }
      const OmplPlanner other(config);
      std::vector<std::vector<Pose2>> together(8);
      std::vector<std::thread> threads;
      for (std::size_t thread = 0; thread < 4; ++thread)
        threads.emplace_back([&, thread] {
          for (const std::size_t query : {thread, thread + 4}) together[query] = path_of(other, query);
        });
      for (std::thread& thread : threads) thread.join();
      for (std::size_t query = 0; query < 8; ++query) {
        ASSERT_EQ(alone[query].size(), together[query].size());
        if (alone[query].empty()) continue;  // memcmp wants an address
        EXPECT_EQ(0, std::memcmp(alone[query].data(), together[query].data(), alone[query].size() * sizeof(Pose2)));
      }
    }
  EXPECT_GT(found, 64U);
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
