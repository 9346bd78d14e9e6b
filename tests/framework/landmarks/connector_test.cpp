#include "framework/landmarks/connector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maps/base/portable_random.hpp"
#include "maps/grid/travel_field.hpp"

namespace cairn {
namespace {

constexpr double kCell_m = 0.1;

void fill(OccupancyGrid& grid, const CellBox& box, LogOdds value) {
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) grid.set_log_odds({x, y}, value);
}

// Shortest paths from cell to cell, and how often it was asked.
class GridPlanner {
 public:
  GridPlanner(const OccupancyGrid& grid, const RobotModel& robot) : grid_(grid), robot_(robot) {}

  PlanResult operator()(const PlanRequest& request) {
    ++asked;
    const DistanceField space(grid_, UnknownPolicy::avoid);
    const TravelField travel(space, request.from.pose->position(), robot_.radius_m);
    PlanResult result;
    const std::vector<Cell> cells = travel.path_to(space.cell_at(request.to.pose->position()));
    if (cells.empty()) return result;
    result.outcome = PlanOutcome::solved;
    for (const Cell& cell : cells) result.path.push_back({space.centre_of(cell).x(), space.centre_of(cell).y(), 0.0});
    for (std::size_t i = 1; i < result.path.size(); ++i)
      result.length_m += (result.path[i].position() - result.path[i - 1].position()).norm();
    return result;
  }

  int asked = 0;

 private:
  const OccupancyGrid& grid_;
  const RobotModel& robot_;
};

class LandmarkConnectorTest : public testing::Test {
 protected:
  LandmarkConnectorTest() {
    fill(grid_, {{0, 0}, {80, 40}}, -1000);
    add_landmark(1.5, 2.0);
    add_landmark(4.5, 2.0);
    add_landmark(7.0, 2.0);
  }

  void add_landmark(double x_m, double y_m) {
    Landmark landmark;
    landmark.T_map_landmark = {x_m, y_m, 0.0};
    graph_.add(landmark);
    const Cell at = grid_.cell_at({x_m, y_m});
    fill(grid_, {{at.x - 1, at.y - 1}, {at.x + 1, at.y + 1}}, 1000);
  }

  // How often the planner was asked.
  int connect(LandmarkConnector& connector, LandmarkGraph& graph) {
    GridPlanner planner(grid_, robot_);
    PoseEstimate pose;
    pose.T_map_robot = {3.0, 1.0, 0.0};
    const WorldView world{grid_, graph, robot_, pose, 0.0, nullptr, 0.0};
    connector.connect(graph, driven_, world, std::ref(planner), 1);
    return planner.asked;
  }
  int connect() { return connect(connector_, graph_); }

  std::map<RouteId, std::pair<LandmarkId, LandmarkId>> ends_by_id() const {
    std::map<RouteId, std::pair<LandmarkId, LandmarkId>> ends;
    for (const auto& [id, route] : graph_.routes()) ends[id] = {route.from, route.to};
    return ends;
  }

  OccupancyGrid grid_{kCell_m};
  RobotModel robot_;
  LandmarksConfig config_;
  LandmarkGraph graph_;
  DrivenPath driven_;
  LandmarkConnector connector_{config_, robot_};
};

TEST_F(LandmarkConnectorTest, JoinsEachPairBothWays) {
  EXPECT_EQ(connect(), 3);
  EXPECT_EQ(graph_.routes().size(), 6U);
  for (const auto& [from, to] : {std::pair(1, 2), std::pair(2, 1), std::pair(1, 3), std::pair(3, 2)})
    EXPECT_NE(graph_.route_between(from, to), nullptr);
}

TEST_F(LandmarkConnectorTest, WhereNothingHasChangedNothingIsPlannedAndTheGraphStaysTheSame) {
  connect();
  const LandmarkGraph before = graph_;
  EXPECT_EQ(connect(), 0);
  EXPECT_EQ(graph_, before);
}

TEST_F(LandmarkConnectorTest, PlansOnlyWhatAChangeOfTheGridCanConcern) {
  connect();
  const auto ids = ends_by_id();
  const Route untouched = *graph_.route_between(2, 3);
  fill(grid_, {{29, 15}, {31, 25}}, 1000);  // between L1 and the others
  EXPECT_EQ(connect(), 2);
  EXPECT_EQ(ends_by_id(), ids) << "routes keep their ids";
  EXPECT_EQ(*graph_.route_between(2, 3), untouched);
  EXPECT_GT(graph_.route_between(1, 2)->cost_m, 3.0);
}

TEST_F(LandmarkConnectorTest, ARouteThatIsBlockedGoesAndComesBackWhenItIsFreeAgain) {
  connect();
  fill(grid_, {{29, 0}, {31, 40}}, 1000);
  connect();
  // The robot stands right of the wall: L1 has no approach pose.
  fill(grid_, {{29, 0}, {31, 40}}, -1000);
  connect();
  EXPECT_EQ(graph_.routes().size(), 6U);
}

TEST_F(LandmarkConnectorTest, ANewLandmarkIsJoinedAndTheOthersKeepTheirRouteIds) {
  connect();
  const auto ids = ends_by_id();
  add_landmark(4.5, 3.4);
  connect();
  for (const auto& [id, ends] : ids) {
    ASSERT_NE(graph_.find_route(id), nullptr);
    EXPECT_EQ(graph_.find_route(id)->from, ends.first);
    EXPECT_EQ(graph_.find_route(id)->to, ends.second);
  }
  EXPECT_EQ(graph_.routes().size(), 12U);
}

TEST_F(LandmarkConnectorTest, RoutesOfAnEarlierRunKeepTheirIds) {
  connect();
  const auto ids = ends_by_id();
  LandmarkConnector resumed(config_, robot_);
  EXPECT_EQ(connect(resumed, graph_), 3);
  EXPECT_EQ(ends_by_id(), ids);
}

TEST_F(LandmarkConnectorTest, APathThatTheRobotHasDrivenMeanwhileReplacesThePlannedOneUnderItsId) {
  connect();
  const Route planned = *graph_.route_between(1, 2);
  EXPECT_FALSE(planned.driven);
  const Pose2 from = *graph_.find(1)->access;
  const Pose2 to = *graph_.find(2)->access;
  for (double s = 0.0; s <= 1.0; s += 0.01)
    driven_.record({from.x_m + s * (to.x_m - from.x_m), from.y_m + s * (to.y_m - from.y_m), 0.0});
  EXPECT_EQ(connect(), 0);
  const Route driven = *graph_.route_between(1, 2);
  EXPECT_TRUE(driven.driven);
  EXPECT_EQ(driven.id, planned.id);
}

// The same costs as planning all routes anew, whatever changes in the map.
TEST_F(LandmarkConnectorTest, UpdatedRoutesCostWhatRoutesPlannedAnewCost) {
  int saved = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    PortableRandom random(seed);
    for (int step = 0; step < 6; ++step) {
      const Cell corner{random.whole(0, 70), random.whole(0, 30)};
      const Cell size{random.whole(1, 8), random.whole(1, 8)};
      const CellBox box{corner, {corner.x + size.x, corner.y + size.y}};
      fill(grid_, box, random.share() < 0.6 ? -1000 : 1000);
      fill(grid_, {{28, 8}, {33, 13}}, -1000);  // the robot's own place
      const int asked = connect();
      LandmarkGraph anew;
      for (const auto& [id, landmark] : graph_.landmarks()) anew.add(landmark);
      LandmarkConnector fresh(config_, robot_);
      saved += connect(fresh, anew) - asked;
      ASSERT_EQ(graph_.routes().size(), anew.routes().size()) << "seed " << seed << ", step " << step;
      for (const auto& [id, route] : anew.routes()) {
        const Route* const updated = graph_.route_between(route.from, route.to);
        ASSERT_NE(updated, nullptr);
        EXPECT_NEAR(updated->cost_m, route.cost_m, 1e-3) << "seed " << seed << ", step " << step;
      }
    }
  }
  EXPECT_GT(saved, 40) << "plans that were not needed";
}

}  // namespace
}  // namespace cairn
