// Which of OMPL's planners find routes for robots that cannot slide sideways.

#include <gtest/gtest.h>

#include "planners/common/pose_space/pose_recheck.hpp"
#include "tests/planners/common/pose_space/motion_measures.hpp"
#include "tests/planners/ompl/pose_search.hpp"

namespace cairn {
namespace {

using test::PoseSearch;

constexpr std::uint64_t kSeeds = 12;

// FMT* asks for each of its samples, and finds nothing before it has them all; some ask often and do little.
std::int64_t iterations_of(Algorithm algorithm) {
  using enum Algorithm;
  switch (algorithm) {
    case fmt:
      return 20000;
    case bi_trrt:
    case est:
    case kpiece:
    case lazy_rrt:
    case stride:
    case trrt:
      return 8000;
    default:
      return 800;
  }
}

struct Case {
  std::string kind_name;
  MotionKind kind;
  std::string name;
  Algorithm algorithm;

  friend void PrintTo(const Case& of, std::ostream* out) { *out << of.kind_name << " " << of.name; }
};

std::vector<Case> working() {
  std::vector<Case> cases;
  const std::pair<std::string, MotionKind> kinds[] = {{"differential", MotionKind::differential},
                                                      {"dubins", MotionKind::dubins},
                                                      {"reeds_shepp", MotionKind::reeds_shepp}};
  for (const auto& [kind_name, kind] : kinds)
    for (const auto& [name, algorithm] : algorithm_names())
      if (works_with(kind, algorithm)) cases.push_back({kind_name, kind, name, algorithm});
  return cases;
}

class WorkingPlanner : public ::testing::TestWithParam<Case> {};

TEST_P(WorkingPlanner, FindsPathsOfWhichEveryMotionFitsAndKeepsTheTurningRadius) {
  const PoseSearch search(GetParam().kind);
  const int wanted = GetParam().algorithm == Algorithm::fmt ? 1 : 2;
  int solved = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds && solved < wanted; ++seed) {
    const std::vector<Pose2> path = search.run(GetParam().algorithm, seed, iterations_of(GetParam().algorithm));
    if (path.empty()) continue;
    ++solved;
    EXPECT_EQ(path.front(), search.from);
    EXPECT_EQ(path.back(), search.to);
    const std::vector<Motion> motions = search.motions_of(path);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      EXPECT_TRUE(motions[i].ends_at(path[i + 1], kMotionEnd));
      EXPECT_FALSE(first_touch(search.world.grid, {}, search.poses.footprint(), motions[i], 0.005)) << "seed " << seed;
      if (GetParam().kind != MotionKind::differential) {
        EXPECT_GE(test::min_radius_m(motions[i]), search.rules.turning_radius_m * (1.0 - 1e-12));
      }
    }
  }
  EXPECT_GT(solved, 0);
}

TEST_P(WorkingPlanner, GivesTheSamePathAgain) {
  const PoseSearch search(GetParam().kind);
  EXPECT_EQ(search.run(GetParam().algorithm, 3, 100), search.run(GetParam().algorithm, 3, 100));
}

INSTANTIATE_TEST_SUITE_P(Ompl, WorkingPlanner, ::testing::ValuesIn(working()),
                         [](const auto& instance) { return instance.param.kind_name + "_" + instance.param.name; });

TEST(WorksWith, ADiscWorksWithAll) {
  for (const auto& [name, algorithm] : algorithm_names())
    EXPECT_TRUE(works_with(MotionKind::holonomic, algorithm)) << name;
}

}  // namespace
}  // namespace cairn
