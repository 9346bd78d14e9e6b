#include "framework/behaviour_tree/condition.hpp"

#include <gtest/gtest.h>

#include "tests/framework/behaviour_tree/scripted_leaves.hpp"

namespace cairn {
namespace {

// A robot at (1, 2) that knows the square L1 at (1, 3), called dock.
class Conditions : public testing::Test {
 protected:
  Conditions() {
    Landmark square;
    square.category = "square";
    square.name = "dock";
    square.T_map_landmark = {1.0, 3.0, 0.0};
    graph_.add(square);
  }

  [[nodiscard]] Status ask(const std::string& yaml, double time_s = 0.0) {
    const std::vector<TreeNode> steps = testing_tree::steps_of("[" + yaml + "]");
    WorldView world{grid_, graph_, robot_, {}, time_s};
    world.pose.T_map_robot = {1.0, 2.0, 0.0};
    world.pose.trust = trust_;
    world.observation = seen_ ? &*seen_ : nullptr;
    return check_(steps.front(), world);
  }
  [[nodiscard]] bool holds(const std::string& yaml, double time_s = 0.0) {
    return ask(yaml, time_s).state == StepState::success;
  }

  OccupancyGrid grid_{0.1};
  LandmarkGraph graph_;
  const RobotModel robot_;
  std::optional<Observation> seen_;
  PoseTrust trust_ = PoseTrust::tracking;
  ConditionCheck check_;
};

TEST_F(Conditions, ALandmarkIsKnownByIdNameOrCategory) {
  for (const char* landmark : {"L1", "dock", "square", "nearest square"})
    EXPECT_TRUE(holds(std::string("landmark_known: ") + landmark)) << landmark;
  for (const char* landmark : {"L2", "docks", "circle", "nearest circle", "nearest dock"})
    EXPECT_FALSE(holds(std::string("landmark_known: ") + landmark)) << landmark;
  EXPECT_EQ(ask("landmark_known: square").reason, "dock is known");
  EXPECT_EQ(ask("landmark_known: circle").reason, "no landmark \"circle\" is known");
}

TEST_F(Conditions, APlaceIsNearOrNot) {
  EXPECT_TRUE(holds("at_place: square"));
  EXPECT_FALSE(holds("at_place: {landmark: square, within_m: 0.9}"));
  EXPECT_TRUE(holds("at_place: {at_m: [1.3, 2.4], within_m: 0.51}"));
  EXPECT_FALSE(holds("at_place: {at_m: [1.3, 2.4], within_m: 0.49}"));
  EXPECT_FALSE(holds("at_place: {landmark: circle, within_m: 1000}"));
  EXPECT_EQ(ask("at_place: square").reason, "1.00 m away");
  EXPECT_EQ(ask("at_place: circle").reason, "no landmark \"circle\" is known");
}

TEST_F(Conditions, ARobotThatIsLostIsAtNoPlace) {
  trust_ = PoseTrust::lost;
  EXPECT_EQ(ask("at_place: square"), (Status{StepState::failure, "the robot does not know where it is"}));
}

TEST_F(Conditions, ABatteryIsAboveItsShareOrNotKnown) {
  EXPECT_EQ(ask("battery_above: 0.3"), (Status{StepState::failure, "the sensor reports no battery"}));
  seen_.emplace();
  EXPECT_EQ(ask("battery_above: 0"), (Status{StepState::failure, "the sensor reports no battery"}));
  seen_->battery_ratio = 0.31;
  EXPECT_EQ(ask("battery_above: 0.3"), (Status{StepState::success, "31.0 % of the battery is left"}));
  EXPECT_FALSE(holds("battery_above: {ratio: 0.31}"));
}

TEST_F(Conditions, TimeIsTheMissions) {
  EXPECT_TRUE(holds("time_before: 60", 59.9));
  EXPECT_FALSE(holds("time_before: 60", 60.0));
  EXPECT_FALSE(holds("time_after: 60", 59.9));
  EXPECT_TRUE(holds("time_after: 60", 60.0));
}

TEST_F(Conditions, TheExploredShareIsCountedOnceASecond) {
  EXPECT_FALSE(holds("explored: 0.5", 10.0));
  EXPECT_TRUE(holds("explored: 0", 10.0));
  grid_.set_log_odds({0, 0}, -1000);
  EXPECT_FALSE(holds("explored: 0.5", 10.9)) << "not counted again yet";
  EXPECT_TRUE(holds("explored: 0.5", 11.0));
  EXPECT_EQ(ask("explored: 0.5", 11.0).reason, "100.0 % explored");
}

}  // namespace
}  // namespace cairn
