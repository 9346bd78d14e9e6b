#include "plugins/behaviours/exploring/known_share.hpp"

#include <gtest/gtest.h>

#include "plugins/behaviours/lookouts/passages.hpp"
#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

const std::string kClosedL = R"(
####################
#..................#
#..................#
#..................#
#..................#
#..................#
#..................#
#.........##########
#...R.....#
#.........#
#.........#
#.........#
#.........#
###########
)";

void count(KnownShare& share, const std::string& drawing, std::size_t unseen_edges, double time_s) {
  const AsciiGrid map(drawing);
  const Pose2 robot{map.at('R').x(), map.at('R').y(), 0.0};
  const FreeSpace space(map.grid, {robot.position(), 0.2, 0.02}, {robot});
  for (int held = 0; held < KnownShareSettings{}.held_counts; ++held)
    share.count(space, reach_of(space, {robot}), unseen_edges, 0.16, time_s);
}

double share_of(const std::string& drawing, std::size_t unseen_edges = 0) {
  KnownShare share;
  count(share, drawing, unseen_edges, 0.0);
  return share.ratio();
}

std::string with_open_end() {
  std::string open = kClosedL;
  for (std::size_t at; (at = open.find(".#\n#.....")) != std::string::npos;) open[at + 1] = ' ';
  return open;
}

TEST(KnownShare, IsOneInAnLWhoseOutlineIsClosed) {
  EXPECT_DOUBLE_EQ(share_of(kClosedL), 1.0);
}

TEST(KnownShare, CountsUnknownGroundBehindAnOpenEnd) {
  EXPECT_LT(share_of(with_open_end()), 0.9);
  EXPECT_GT(share_of(with_open_end()), 0.0);
}

TEST(KnownShare, CountsNothingBehindAnEndThatWasFoundClosed) {
  const AsciiGrid map(with_open_end());
  const Pose2 robot{map.at('R').x(), map.at('R').y(), 0.0};
  const FreeSpace space(map.grid, {robot.position(), 0.2, 0.02}, {robot});
  std::vector<Point> closed;
  for (double y_m = 0.0; y_m < 1.5; y_m += 0.1)
    for (const double x_m : {1.2, 2.2}) closed.emplace_back(x_m, y_m);
  KnownShare share;
  share.count(space, reach_of(space, {robot}), 0, 0.16, 0.0, closed);
  share.settle();
  EXPECT_GT(share.ratio(), share_of(with_open_end()));
}

TEST(KnownShare, CountsWhatEdgesThatWereSeenFromAfarMayHide) {
  EXPECT_LT(share_of(kClosedL, 20), 1.0);
  EXPECT_LT(share_of(kClosedL, 60), share_of(kClosedL, 20));
}

TEST(KnownShare, NeverFalls) {
  KnownShare share;
  count(share, kClosedL, 10, 0.0);
  const double before = share.ratio();
  count(share, with_open_end(), 100, 10.0);
  EXPECT_DOUBLE_EQ(share.ratio(), before);
  count(share, kClosedL, 0, 20.0);
  EXPECT_DOUBLE_EQ(share.ratio(), 1.0);
}

// Noise closes a door for a moment.
TEST(KnownShare, ARiseCountsOnceItHasHeld) {
  KnownShare share;
  count(share, with_open_end(), 0, 0.0);
  const double before = share.ratio();
  const AsciiGrid map(kClosedL);
  const Pose2 robot{map.at('R').x(), map.at('R').y(), 0.0};
  const FreeSpace space(map.grid, {robot.position(), 0.2, 0.02}, {robot});
  share.count(space, reach_of(space, {robot}), 0, 0.16, 10.0);
  EXPECT_DOUBLE_EQ(share.ratio(), before);
  count(share, with_open_end(), 0, 20.0);
  EXPECT_DOUBLE_EQ(share.ratio(), before);
  count(share, kClosedL, 0, 30.0);
  EXPECT_DOUBLE_EQ(share.ratio(), 1.0);
}

// A hole in a wall leads all round the home: it is no more than a room.
TEST(KnownShare, AGapToTheOutsideCountsAsOneRoom) {
  std::string leaky = "\n" + std::string(120, '#') + "\n";
  for (int y = 0; y < 60; ++y) {
    const bool is_gap = y >= 30 && y < 33;
    leaky += "#" + (y == 20 ? std::string(60, '.') + "R" + std::string(57, '.') : std::string(118, '.')) +
             (is_gap ? " " : "#") + "\n";
  }
  leaky += std::string(120, '#') + "\n";
  EXPECT_LT(share_of(leaky), 1.0);
  EXPECT_GT(share_of(leaky), 0.9);
}

TEST(KnownShare, IsDueEveryFewSeconds) {
  KnownShare share;
  EXPECT_TRUE(share.is_due(0.0));
  count(share, kClosedL, 0, 0.0);
  EXPECT_FALSE(share.is_due(1.0));
  EXPECT_TRUE(share.is_due(5.0));
}

}  // namespace
}  // namespace cairn::behaviours
