#include "framework/mission/loop/planning.hpp"

#include <gmock/gmock.h>

#include "tests/framework/mission/loop/host_fixture.hpp"

namespace cairn {
namespace {

// A free floor of 6 x 4 m with two squares of 0.4 m at (1.5, 2) and (4.5, 2), both known.
class PlanningTest : public HostFixture {
 protected:
  PlanningTest() {
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 60; ++x) {
        const bool block = y >= 18 && y < 22 && ((x >= 13 && x < 17) || (x >= 43 && x < 47));
        grid_.set_log_odds({x, y}, block ? 1000 : -1000);
      }
    for (const double x_m : {1.5, 4.5}) {
      Matching matching;
      matching.degrees = {{"square", 0.9, 0.0, {x_m, 2.0}}};
      matching.detection = Detection{"square", {x_m, 2.0, 0.0}, 0.9, {}};
      (void)tracker_.update(matching);
    }
    known_.pose.T_map_robot = {3.0, 1.0, 0.0};
  }
  LandmarkTracker tracker_{{.confirm_sightings = 1},
                           mission_.robot,
                           {{"square", Contour::polygon({{0, 0}, {0.4, 0}, {0.4, 0.4}, {0, 0.4}})}}};
  WorldState known_{mission_.robot, tracker_.graph(), Pose2{}, &grid_};
};

TEST_F(PlanningTest, JoinsLandmarksByRoutesWhileTheRobotStands) {
  attach_drive();
  planning().connect(tracker_, known_.view());
  EXPECT_THAT(drive_->commands, testing::ElementsAre(Twist{}));
  EXPECT_GT(planner_->asked, 0);
  EXPECT_FALSE(tracker_.graph().routes().empty());
}

TEST_F(PlanningTest, WithoutLandmarksOrWithoutAPlannerNothingIsAsked) {
  attach_drive();
  LandmarkTracker none{{}, mission_.robot, {}};
  planning().connect(none, world_.view());
  EXPECT_EQ(planner_->asked, 0);
  EXPECT_TRUE(drive_->commands.empty()) << "and the robot does not stop for it";

  mission_.config.planner.name.clear();
  built_.planner = nullptr;
  StagedModules modules(built_, mission_, time_);
  Planning without(mission_, modules, graph_, {}, monitor_, {});
  EXPECT_FALSE(without.has_planner());
  without.connect(tracker_, known_.view());
  EXPECT_TRUE(drive_->commands.empty());
}

TEST_F(PlanningTest, ThePlannerGetsTheHierarchiesWithTheWorld) {
  (void)planning().plan({}, world_.view());
  EXPECT_TRUE(planner_->knew_hierarchies);
}

TEST_F(PlanningTest, APlannerThatThrowsIsAFaultOfItsStage) {
  class Broken : public Planner {
    PlanResult plan(const PlanRequest&, const WorldView&, const Budget&) const override {
      throw std::runtime_error("lost");
    }
  };
  built_.planner = std::make_shared<Broken>();
  const auto fault_of = [&](auto call) -> std::string {
    try {
      call();
    } catch (const ModuleFault& fault) {
      return fault.what();
    }
    return "no fault";
  };
  EXPECT_EQ(fault_of([&] { (void)planning().plan({}, world_.view()); }),
            "module straight failed in stage planner: lost");
  EXPECT_EQ(fault_of([&] { planning().connect(tracker_, known_.view()); }),
            "module straight failed in stage routes: lost");
}

}  // namespace
}  // namespace cairn
