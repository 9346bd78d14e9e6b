#include "plugins/behaviours/following/direct_follower.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/behaviours/fake_host.hpp"

namespace cairn::behaviours {
namespace {

const std::string kRoom = R"(
  ##########
  #........#
  #.R......#
  #........#
  ##########
)";

TEST(DirectFollower, AsksTheControllerNotToMindObstacles) {
  struct Asked : Controller {
    ControlResult control(const ControlRequest& request, const WorldView&) override {
      seen = request;
      return {};
    }
    ControlRequest seen;
  };
  FakeHost host(kRoom);
  const auto controller = std::make_shared<Asked>();
  host.controller = controller;
  DirectFollower follower(0.15, 0.07, ProgressChecker());
  follower.begin({{0.2, 0.2}, {0.6, 0.2}});
  (void)follower.ask(host);
  EXPECT_FALSE(controller->seen.avoids_obstacles);
  EXPECT_TRUE(controller->seen.is_new_path);
  EXPECT_DOUBLE_EQ(controller->seen.speed_mps, 0.15);
  EXPECT_DOUBLE_EQ(controller->seen.tolerance_m, 0.07);
}

TEST(DirectFollower, IsStuckWhenTheRobotStandsThoughItWantsToDrive) {
  FakeHost host(kRoom);
  const OccupancyGrid grid(0.05);
  DirectFollower follower(0.15, 0.07, ProgressChecker(1.0));
  const auto is_stuck_after = [&](double seconds) {
    bool is_stuck = false;
    for (double time_s = 0.0; time_s < seconds; time_s += 0.1)
      is_stuck = follower.is_stuck(WorldView{grid, host.graph, host.robot, {}, time_s, nullptr});
    return is_stuck;
  };
  follower.drive({0.1, 0.0}, host);
  EXPECT_TRUE(is_stuck_after(2.0));
  follower.restart_progress();
  follower.stop();
  EXPECT_FALSE(is_stuck_after(2.0)) << "nothing is wanted";
}

}  // namespace
}  // namespace cairn::behaviours
