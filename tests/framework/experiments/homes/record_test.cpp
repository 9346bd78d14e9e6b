#include "framework/experiments/homes/record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/files/world_file.hpp"
#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

struct Exploring : testing::Test {
  Exploring() : home(random_home({}, 3)), world(loaded(home)), record({}, home, world, robot.radius_m) {}

  static World loaded(const Home& home) {
    const config_test::TestFolder folder;
    return load_world(folder.write("world.yaml", home.world_yaml), {});
  }
  void be_at(const Point& p_m, double time_s) {
    const WorldView view{grid, graph, robot, {}, time_s};
    MissionView mission{view};
    mission.truth.emplace();
    mission.truth->T_map_robot = {p_m.x(), p_m.y(), 0.0};
    record.on(TickDone{}, mission);
  }
  [[nodiscard]] static Point middle_of(const HomeRoom& room) { return 0.5 * (room.min_m + room.max_m); }

  OccupancyGrid grid{0.05};
  LandmarkGraph graph;
  RobotModel robot;
  Home home;
  World world;
  HomeRecord record;
};

TEST_F(Exploring, RoomsCountOnceTheRobotIsInThem) {
  be_at(home.start_m, 0.0);
  be_at(middle_of(home.rooms[0]), 1.0);
  be_at(middle_of(home.rooms[1]), 2.0);
  be_at(middle_of(home.rooms[0]), 3.0);
  const HomeVerdict verdict = record.verdict({}, {});
  EXPECT_EQ(verdict.rooms, static_cast<int>(home.rooms.size()));
  EXPECT_GE(verdict.entered, 2);
  EXPECT_LE(verdict.entered, 3);
  EXPECT_EQ(static_cast<int>(verdict.not_entered.size()), verdict.rooms - verdict.entered);
  EXPECT_THAT(verdict.not_entered, testing::Not(testing::Contains(testing::AnyOf(0, 1))));
}

TEST_F(Exploring, TheShareIsThatOfWhereTheRobotCanBe) {
  be_at(home.start_m, 0.0);
  EXPECT_EQ(record.verdict({}, {}).known_ratio, 0.0);
  EXPECT_FALSE(record.verdict({}, {}).known_90_s);
  for (double x_m = 0.0; x_m < world.max_m.x(); x_m += 0.02)
    for (double y_m = 0.0; y_m < world.max_m.y(); y_m += 0.02) grid.set_log_odds(grid.cell_at({x_m, y_m}), -300);
  be_at(home.start_m, 7.0);
  EXPECT_GT(record.verdict({}, {}).known_ratio, 0.99);
  EXPECT_EQ(record.verdict({}, {}).known_90_s, 7.0);
}

TEST_F(Exploring, OnlyFastContactsWithWhatCouldBeSeenAreFast) {
  std::vector<TimedContact> contacts(3);
  contacts[0].contact = {};
  contacts[0].contact.could_be_seen = true;
  contacts[0].contact.speed_mps = 0.2;
  contacts[1].contact.could_be_seen = true;
  contacts[1].contact.speed_mps = 0.01;
  contacts[2].contact.speed_mps = 0.2;
  const HomeVerdict verdict = record.verdict({}, contacts);
  EXPECT_EQ(verdict.contacts, 3);
  EXPECT_EQ(verdict.fast_contacts, 1);
}

}  // namespace
}  // namespace cairn
