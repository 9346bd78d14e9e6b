#include "plugins/behaviours/lookouts/passages.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

// Cells of 0.1 m and a robot of 0.4 m that keeps 0.1 m: a doorway of 0.5 m whose cells are not known, and what is
// behind it is not either.
const std::string kHalfKnown = R"(
############
#..........#
#..........#
#..........#
#...........
#...........
#..R........
#...........
#..........#
#..........#
#..........#
############
)";

struct Seen {
  explicit Seen(const std::string& drawing)
      : map(drawing),
        robot{map.at('R').x(), map.at('R').y(), 0.0},
        space(map.grid, {robot.position(), 0.2, 0.1}, {robot}),
        reach(reach_of(space, {robot})) {}

  [[nodiscard]] std::optional<Passage> nearest(const PassageSearch& search = {},
                                               const PassageSettings& settings = {}) const {
    return nearest_passage(space, map.grid, reach, robot.position(), search, settings);
  }

  AsciiGrid map;
  Pose2 robot;
  FreeSpace space;
  CellLayer<char> reach;
};

TEST(NearestPassage, LeadsThroughADoorwayThatIsHalfKnown) {
  const Seen seen(kHalfKnown);
  const std::optional<Passage> passage = seen.nearest();
  ASSERT_TRUE(passage);
  EXPECT_NEAR(passage->at_m.x(), 1.15, 0.25);
  EXPECT_NEAR(passage->at_m.y(), 0.6, 0.2);
  EXPECT_NEAR(passage->width_m, 0.5, 0.11);
  EXPECT_GT(passage->beyond_m.x(), 1.3);
}

TEST(NearestPassage, IsLookedAtFromStraightBeforeIt) {
  const Seen seen(kHalfKnown);
  const std::optional<Passage> passage = seen.nearest();
  ASSERT_TRUE(passage);
  const Point lookout = seen.space.centre_of(passage->lookout);
  EXPECT_NEAR(lookout.y(), passage->at_m.y(), 0.15);
  EXPECT_NEAR(passage->at_m.x() - lookout.x(), 0.7, 0.2);
  EXPECT_TRUE(seen.reach.at(passage->lookout));
}

TEST(NearestPassage, IsNoneWhereTheOutlineIsClosed) {
  std::string closed = kHalfKnown;
  for (std::size_t at; (at = closed.find(".\n")) != std::string::npos;) closed[at] = '#';
  EXPECT_FALSE(Seen(closed).nearest());
}

TEST(NearestPassage, IsNoneWhereItWasTriedBefore) {
  const Seen seen(kHalfKnown);
  EXPECT_FALSE(seen.nearest({false, {seen.nearest()->at_m}}));
}

TEST(NearestPassage, IsNoneThroughAGapNarrowerThanAskedFor) {
  PassageSettings settings;
  settings.min_radius_m = 0.3;
  EXPECT_FALSE(Seen(kHalfKnown).nearest({}, settings));
}

TEST(NearestPassage, IsSuspectedInAWallThatEchoesHaveComeThrough) {
  std::string closed = kHalfKnown;
  for (std::size_t at; (at = closed.find(".\n")) != std::string::npos;) closed[at] = '#';
  EXPECT_FALSE(Seen(closed).nearest({true, {}})) << "nothing has come through";

  AsciiGrid map(closed);
  for (int x = 0; x < 6; ++x)
    for (int y = 4; y < 9; ++y) map.grid.set_log_odds(map.grid.cell_at({1.25 + 0.1 * x, 0.05 + 0.1 * y}), -100);
  const Pose2 robot{map.at('R').x(), map.at('R').y(), 0.0};
  const FreeSpace space(map.grid, {robot.position(), 0.2, 0.1}, {robot});
  const auto suspect = nearest_passage(space, map.grid, reach_of(space, {robot}), robot.position(), {true, {}});
  ASSERT_TRUE(suspect);
  EXPECT_NEAR(suspect->at_m.x(), 1.15, 0.2);
  EXPECT_GT(suspect->at_m.y(), 0.3);
  EXPECT_LT(suspect->at_m.y(), 1.0);
}

TEST(ReachOf, HoldsWhatCanBeReachedFromAnywhereTheRobotHasBeen) {
  const AsciiGrid map(R"(
###################
#........#........#
#........#........#
#........#........#
#..R.....#.....S..#
#........#........#
#........#........#
#........#........#
###################
)");
  const Pose2 robot{map.at('R').x(), map.at('R').y(), 0.0};
  const Pose2 before{map.at('S').x(), map.at('S').y(), 0.0};
  const FreeSpace space(map.grid, {robot.position(), 0.2, 0.1}, {robot, before});
  EXPECT_FALSE(reach_of(space, {robot}).at(space.cell_at(before.position())));
  EXPECT_TRUE(reach_of(space, {robot, before}).at(space.cell_at(before.position())));
  EXPECT_TRUE(reach_of(space, {robot, before}).at(space.cell_at(robot.position())));
}

}  // namespace
}  // namespace cairn::behaviours
