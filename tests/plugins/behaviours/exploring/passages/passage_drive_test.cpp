#include "plugins/behaviours/exploring/passages/passage_drive.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/behaviours/fake_host.hpp"

namespace cairn::behaviours {
namespace {

// A doorway of 0.6 m at x = 1.25 m.
const std::string kDoor = R"(
########################
#...........#..........#
#...........#..........#
#...........#..........#
#......................#
#......................#
#....R.................#
#......................#
#......................#
#......................#
#...........#..........#
#...........#..........#
#...........#..........#
########################
)";

ExploreTask through(double width_m) {
  ExploreTask task;
  task.kind = TaskKind::passage;
  task.about = {1.25, 0.7};
  task.lookout = {0.6, 0.7};
  task.beyond_m = {1.85, 0.7};
  task.width_m = width_m;
  return task;
}

// Begins in its first tick.
struct Driver : Behaviour {
  Driver(const ExploreConfig& config, const ExploreTask& wanted) : drive(config), task(wanted) {}
  Status tick(const WorldView& world, BehaviourContext& context) override {
    if (!has_begun) drive.begin(task, world);
    has_begun = true;
    return drive.tick(task, world, context);
  }
  void halt() override {}
  PassageDrive drive;
  ExploreTask task;
  bool has_begun = false;
};

TEST(PassageDrive, LeadsThroughADoorThatTheMapDrawsShut) {
  FakeHostSettings settings;
  settings.all_known = true;
  settings.sight_m = 0.0;  // the map stays as it is
  FakeHost host(kDoor, settings);
  host.robot.radius_m = 0.2;
  for (double y_m = 0.2; y_m < 1.2; y_m += 0.05) host.grid.set_log_odds(host.grid.cell_at({1.25, y_m}), 600);
  Driver driver(ExploreConfig{}, through(0.6));
  const Status status = host.run(driver, 60.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
  EXPECT_GT(host.T_map_robot.x_m, 1.6);
}

TEST(PassageDrive, ATighterOneIsPassedMoreSlowly) {
  double took_s[2] = {0.0, 0.0};
  for (const int i : {0, 1}) {
    FakeHost host(kDoor);
    host.robot.radius_m = 0.2;
    Driver driver(ExploreConfig{}, through(i == 0 ? 0.6 : 0.36));
    EXPECT_EQ(host.run(driver, 60.0).state, StepState::success);
    took_s[i] = host.time_s;
  }
  EXPECT_GT(took_s[1], 1.5 * took_s[0]);
}

TEST(PassageDrive, WhereTheRobotIsBlockedEachClearanceIsTriedThenItIsGivenUpWithTheReason) {
  std::string shut = kDoor;
  for (std::size_t row = 0, at = 1; row < 14; ++row, at += 25) shut[at + 12] = '#';
  FakeHostSettings settings;
  settings.sight_m = 0.0;
  FakeHost host(shut, settings);
  host.robot.radius_m = 0.2;
  Driver driver(ExploreConfig{}, through(0.7));
  const Status status = host.run(driver, 200.0);
  EXPECT_EQ(status.state, StepState::failure) << host.picture();
  EXPECT_NE(status.reason.find("blocked at (1."), std::string::npos) << status.reason;
  EXPECT_NE(status.reason.find("with 0.02 m beside the robot"), std::string::npos) << status.reason;
}

}  // namespace
}  // namespace cairn::behaviours
