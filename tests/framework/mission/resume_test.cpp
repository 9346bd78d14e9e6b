#include "framework/mission/resume.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/mission/saved_content.hpp"
#include "tests/framework/mission/still_modules.hpp"

namespace cairn {
namespace {

using testing::HasSubstr;

class ResumeTest : public testing::Test {
 protected:
  ResumeTest() {
    map_.properties = properties_of(mission_);
    map_.progress = MissionProgress{};
    map_.progress->step_name = mission_.steps.front().name;
  }
  template <class Call>
  static std::string error_of(Call call) {
    try {
      call();
    } catch (const StoreError& error) {
      return error.what();
    }
    return "no error";
  }
  [[nodiscard]] std::string refusal() const {
    return error_of([&] { check_resumable(map_, mission_); });
  }

  Mission mission_ = still::mission(10);
  SavedMap map_;
};

TEST_F(ResumeTest, AMapOfTheSameMissionIsGoneOnWith) {
  EXPECT_EQ(refusal(), "no error");
  EXPECT_EQ(seed_of(map_), 1);
}

TEST_F(ResumeTest, AMapThatNoMissionSavedIsRefused) {
  map_.progress.reset();
  EXPECT_THAT(refusal(), HasSubstr("it does not say how far a mission had come"));
  map_.properties.erase("seed");
  EXPECT_THAT(error_of([&] { (void)seed_of(map_); }), HasSubstr("with which seed"));
}

TEST_F(ResumeTest, AMapOfAnotherMissionRobotOrStepIsRefused) {
  mission_.config.mission = "other";
  EXPECT_THAT(refusal(), HasSubstr("the map was made by mission \"still\", the mission's is \"other\""));
  mission_.config.mission = "still";
  mission_.robot.radius_m = 1.0;
  EXPECT_THAT(refusal(), HasSubstr("with a robot radius, in metres, of"));
  mission_.robot = {};
  map_.progress->step = 1;
  EXPECT_THAT(refusal(), HasSubstr("the map was saved at step 2, still_step; in this mission there comes the end"));
}

TEST_F(ResumeTest, AMapOfAnotherWorldIsRefusedButOneWithoutAWordOnItPasses) {
  const auto check = [&] { return error_of([&] { check_same_world(map_, mission_); }); };
  EXPECT_EQ(check(), "no error");
  map_.properties["world"] = "0123";
  EXPECT_THAT(check(), HasSubstr("the map was made in another world"));
  mission_.world_fingerprint = "0123";
  EXPECT_EQ(check(), "no error");
}

TEST_F(ResumeTest, PausesComeBackAsTheyWereAndNothingIsWrittenOfNone) {
  add_pauses(map_, 0.0);
  EXPECT_FALSE(map_.properties.contains("paused_s"));
  EXPECT_EQ(paused_before(map_), 0.0);
  add_pauses(map_, 0.1 + 0.2);
  EXPECT_EQ(paused_before(map_), 0.1 + 0.2);
  for (const char* damaged : {"1x", "-1", "nan", "1e300"}) {
    map_.properties["paused_s"] = damaged;
    EXPECT_THAT(error_of([&] { (void)paused_before(map_); }), HasSubstr("not a time in seconds")) << damaged;
  }
}

TEST_F(ResumeTest, TheStateOfATreeComesBackAsItWas) {
  EXPECT_FALSE(saved_tree(map_));
  NodeState node;
  node.path = "1";
  node.rounds = 3;
  node.begun_s = 0.1;
  const SavedTree tree{tree_fingerprint(mission_.steps.front()), {{node}}};
  add_tree(map_, tree);
  EXPECT_EQ(saved_tree(map_)->fingerprint, tree.fingerprint);
  EXPECT_EQ(saved_tree(map_)->state, tree.state);
  map_.properties[kTreeStateProperty] = "{";
  EXPECT_THAT(error_of([&] { (void)saved_tree(map_); }), HasSubstr("its property tree_state"));
}

TEST_F(ResumeTest, AGridOfOtherCellsIsRefused) {
  EXPECT_EQ(error_of([] { check_same_cells(OccupancyGrid(0.05), OccupancyGrid(0.05)); }), "no error");
  EXPECT_THAT(error_of([] { check_same_cells(OccupancyGrid(0.05), OccupancyGrid(0.1)); }),
              HasSubstr("the map has cells of 0.05 m, the mission's of 0.1 m"));
}

}  // namespace
}  // namespace cairn
