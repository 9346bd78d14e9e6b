#include "plugins/behaviours/lookouts/look_closer.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "plugins/behaviours/lookouts/frontiers.hpp"
#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

// 5 x 3.5 m with an object of 0.5 m in the middle.
AsciiGrid open_room() {
  std::string drawing;
  for (int r = 0; r < 35; ++r) {
    std::string row(50, '.');
    if (r == 0 || r == 34) row = std::string(50, '#');
    row.front() = row.back() = '#';
    if (r >= 15 && r < 20) row.replace(23, 5, "#####");
    if (r == 17) row[5] = 'R';
    drawing += row + "\n";
  }
  return AsciiGrid(drawing);
}

FreeSpace space_of(const AsciiGrid& map) {
  return FreeSpace(map.grid, {map.at('R'), 0.2, 0.1}, {{map.at('R').x(), map.at('R').y(), 0.0}});
}

std::vector<Pose2> ring(const Point& centre, double radius_m, double from_deg, double to_deg) {
  std::vector<Pose2> poses;
  for (double a = from_deg; a <= to_deg; a += 3.0)
    poses.push_back(Pose2{centre.x(), centre.y(), radians(a)} * Pose2{radius_m, 0.0, radians(90.0)});
  return poses;
}

const Point kCentre{2.55, 1.75};

TEST(CompactObjects, AreTheOnesThatFit) {
  const FreeSpace space = space_of(open_room());
  const std::vector<CellGroup> objects = compact_objects(space, 1.5);
  ASSERT_THAT(objects, SizeIs(1));
  EXPECT_THAT(objects[0], SizeIs(25));
  EXPECT_THAT(compact_objects(space, 0.4), IsEmpty());
}

TEST(OrbitRound, IsOpenAllRoundAnObjectThatStandsFree) {
  const FreeSpace space = space_of(open_room());
  const CellGroup object = compact_objects(space, 1.5).at(0);
  const Orbit orbit = orbit_round(space, object, {}, {}, {});
  EXPECT_LT((orbit.centre - kCentre).norm(), 1e-9);
  EXPECT_EQ(orbit.count(SectorState::open), kOrbitSectors);
  EXPECT_TRUE(orbit.is_round_trip());
  for (const Sector& sector : orbit.sectors) {
    double nearest_m = 1e9;
    for (const Cell c : object)
      nearest_m = std::min(nearest_m, (space.centre_of(c) - space.centre_of(sector.lookout)).norm());
    EXPECT_NEAR(nearest_m, 0.55, 0.1);
  }
}

TEST(OrbitRound, CoversTheSectorsThatTheRobotHasBeenIn) {
  const FreeSpace space = space_of(open_room());
  const CellGroup object = compact_objects(space, 1.5).at(0);
  EXPECT_EQ(orbit_round(space, object, ring(kCentre, 0.8, 0, 360), {}, {}).count(SectorState::covered), kOrbitSectors);
  EXPECT_EQ(orbit_round(space, object, ring(kCentre, 0.8, -7, 187), {}, {}).count(SectorState::covered), 13);
  EXPECT_EQ(orbit_round(space, object, ring(kCentre, 1.5, 0, 360), {}, {}).count(SectorState::covered), 0);
}

TEST(OrbitRound, IsNoRoundTripBehindAWallSeenFromOneSide) {
  const AsciiGrid map(R"(
..............................
..............................
..............................
..............................
..............................
..............................
..............................
..............................
..............................
R.............................
..............................
.........##########...........
)");
  const FreeSpace space = space_of(map);
  const Orbit orbit = orbit_round(space, compact_objects(space, 1.5).at(0), {}, {}, {});
  EXPECT_GE(orbit.count(SectorState::hidden), 8);
  EXPECT_FALSE(orbit.is_round_trip());
}

TEST(OrbitRound, LeavesOutTheSideThatStandsAgainstAWall) {
  std::string drawing;
  for (int r = 0; r < 25; ++r) {
    std::string row(50, '.');
    if (r == 24) row = std::string(50, '#');
    if (r >= 16 && r < 21) row.replace(23, 5, "#####");  // 0.3 m from the wall
    if (r == 4) row[5] = 'R';
    drawing += row + "\n";
  }
  const AsciiGrid map(drawing);
  const FreeSpace space = space_of(map);
  const Orbit orbit = orbit_round(space, compact_objects(space, 1.5).at(0), {}, {}, {});
  EXPECT_GE(orbit.count(SectorState::blocked), 5);
  EXPECT_TRUE(orbit.is_round_trip());
}

TEST(OrbitRoute, GoesAllTheWayRoundFromTheNearestSector) {
  const AsciiGrid map = open_room();
  const FreeSpace space = space_of(map);
  const Orbit orbit = orbit_round(space, compact_objects(space, 1.5).at(0), {}, {}, {});
  const OrbitRoute route = orbit_route(space, orbit, {map.at('R').x(), map.at('R').y(), 0.0});
  EXPECT_LT(space.centre_of(route.first).x(), kCentre.x());  // the robot comes from the left
  double turned_rad = 0.0;
  for (std::size_t i = 1; i < route.path.size(); ++i) {
    const Point a = route.path[i - 1] - kCentre;
    const Point b = route.path[i] - kCentre;
    if (a.norm() < 1.2) turned_rad += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  EXPECT_GT(std::abs(degrees(turned_rad)), 330.0);
}

TEST(OrbitRoute, GoesOnInTheDirectionThatIsLeft) {
  const AsciiGrid map = open_room();
  const FreeSpace space(map.grid, {kCentre + Point{-0.8, 0.0}, 0.2, 0.1}, {{0.55, 1.75, 0.0}});
  // Half an orbit is done, clockwise from the right over the top: on through the bottom.
  const Orbit orbit = orbit_round(space, compact_objects(space, 1.5).at(0), ring(kCentre, 0.8, 0, 180), {}, {});
  const OrbitRoute route = orbit_route(space, orbit, {1.75, 1.75, radians(90.0)});
  EXPECT_LT(space.centre_of(route.first).y(), kCentre.y());
  EXPECT_GT(route.path.back().x(), kCentre.x());
}

TEST(OrbitRoute, IsEmptyWhenNothingIsOpen) {
  const FreeSpace space = space_of(open_room());
  const Orbit orbit = orbit_round(space, compact_objects(space, 1.5).at(0), ring(kCentre, 0.8, 0, 360), {}, {});
  EXPECT_TRUE(orbit_route(space, orbit, {}).path.empty());
}

TEST(Unseen, IsWhatNoPoseOfTheTraceHasSeenFromNear) {
  const FreeSpace space = space_of(open_room());
  const std::vector<Cell> all = edge_cells(space);
  CellSet seen;
  EXPECT_THAT(unseen(space, all, {}, {0.9}, seen), SizeIs(all.size()));
  EXPECT_THAT(unseen(space, all, {{2.55, 0.8, 0.0}}, {0.9}, seen), testing::Each(testing::Truly([&](Cell c) {
                return (space.centre_of(c) - Point{2.55, 0.8}).norm() > 0.9 || c.y > 17;
              })));
  // It stays seen.
  EXPECT_LT(unseen(space, all, {}, {0.9}, seen).size(), all.size());
}

TEST(Unseen, LeavesWhatIsBehindTheRobotWhenItLooksAheadOnly) {
  const FreeSpace space = space_of(open_room());
  CellSet seen;
  const std::vector<Cell> cells{{20, 8}, {14, 8}};
  EXPECT_THAT(unseen(space, cells, {{1.75, 0.85, 0.0}}, {0.9, radians(60.0)}, seen), testing::ElementsAre(Cell{14, 8}));
}

}  // namespace
}  // namespace cairn::behaviours
