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

TEST_F(PlanningTest, APathThatIsNotFiniteIsAFaultOfThePlanner) {
  attach_drive();
  planner_->returns_nan = true;
  const auto is_named = testing::ThrowsMessage<ModuleFault>(
      testing::HasSubstr("module straight failed in stage routes: returned a path that is not finite"));
  EXPECT_THAT([&] { planning().connect(tracker_, known_.view()); }, is_named);
  PlanRequest request;
  request.from.pose = Pose2{};
  request.to.pose = Pose2{1.0, 0.0, 0.0};
  EXPECT_THROW((void)planning().plan(request, world_.view()), ModuleFault);
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

// Two rows of five, joined by one route.
SavedMap map_of_two_rows(const ClustersConfig& config) {
  SavedMap map;
  std::vector<LandmarkId> ids;
  for (int i = 0; i < 10; ++i) {
    Landmark landmark;
    landmark.category = "place";
    landmark.T_map_landmark = {1.0 * (i % 5), i < 5 ? 0.0 : 6.0, 0.0};
    ids.push_back(map.graph.add(landmark));
  }
  for (std::size_t i = 0; i + 1 < ids.size(); ++i)
    map.graph.add_route({.from = ids[i], .to = ids[i + 1], .cost_m = i == 4 ? 6.0 : 1.0});
  map.properties[kClustersProperty] = text_of(config);
  map.clusters = cluster_landmarks(map.graph, {}, {config.sizes(), {}});
  return map;
}

TEST(ClustersToBeginWith, AreThoseOfTheMapOrMadeAnewByOtherSettingsWithTheirNames) {
  const ClustersConfig saved;
  SavedMap map = map_of_two_rows(saved);
  ASSERT_GE(map.clusters.clusters.size(), 2U);
  Cluster& named = map.clusters.clusters.begin()->second;
  named.name = "kitchen";
  EXPECT_EQ(clusters_to_begin_with(saved, nullptr), ClusterTree{});
  EXPECT_EQ(clusters_to_begin_with(saved, &map), map.clusters);

  ClustersConfig smaller;
  smaller.max_landmarks = 2;
  const ClusterTree made = clusters_to_begin_with(smaller, &map);
  EXPECT_GT(made.clusters.size(), map.clusters.clusters.size());
  for (const auto& [id, cluster] : made.clusters) EXPECT_LE(members_of(made, id).size(), 2U);
  const Cluster* const heir = find_cluster(made, map.graph, "kitchen");
  ASSERT_NE(heir, nullptr);
  EXPECT_THAT(members_of(made, heir->id), testing::Contains(named.anchor));

  ClustersConfig none;
  none.from_landmarks = 100;
  EXPECT_TRUE(clusters_to_begin_with(none, &map).clusters.empty());
}

}  // namespace
}  // namespace cairn
