#include "framework/landmarks/connector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "framework/landmarks/trajectories.hpp"
#include "maps/base/portable_random.hpp"
#include "maps/landmarks/joined_landmarks.hpp"
#include "tests/framework/landmarks/connecting.hpp"

namespace cairn {
namespace {

constexpr double kCell_m = 0.1;

class LandmarkConnectorTest : public testing::Test {
 protected:
  LandmarkConnectorTest() {
    fill(grid_, {{0, 0}, {80, 40}}, -1000);
    add_landmark(1.5, 2.0);
    add_landmark(4.5, 2.0);
    add_landmark(7.0, 2.0);
  }

  void add_landmark(double x_m, double y_m) { cairn::add_landmark(graph_, grid_, x_m, y_m); }

  void connect_by(const LandmarkConnector::Plan& plan, LandmarkConnector& connector, LandmarkGraph& graph) {
    PoseEstimate pose;
    pose.T_map_robot = T_map_robot_;
    connector.connect(graph, driven_, {grid_, graph, robot_, pose}, plan, 1);
  }
  void connect_by(const LandmarkConnector::Plan& plan) { connect_by(plan, connector_, graph_); }
  // How often the planner was asked.
  int connect(LandmarkConnector& connector, LandmarkGraph& graph) {
    GridPlanner planner(grid_, robot_.radius_m);
    connect_by(std::ref(planner), connector, graph);
    return planner.asked;
  }
  int connect() { return connect(connector_, graph_); }

  std::map<RouteId, std::pair<LandmarkId, LandmarkId>> ends_by_id() const {
    std::map<RouteId, std::pair<LandmarkId, LandmarkId>> ends;
    for (const auto& [id, route] : graph_.routes()) ends[id] = {route.from, route.to};
    return ends;
  }

  // Two rooms with four landmarks each, as far from each other as those of one room are near; a door joins them.
  void make_two_rooms() {
    graph_ = {};
    grid_ = OccupancyGrid(kCell_m);
    fill(grid_, {{0, 0}, {120, 40}}, -1000);
    fill(grid_, {{59, 0}, {61, 40}}, 1000);
    fill(grid_, {{59, 15}, {61, 25}}, -1000);
    for (const double room_m : {0.0, 8.0})
      for (const auto& [x_m, y_m] :
           {std::pair(1.0, 1.0), std::pair(2.5, 1.0), std::pair(1.0, 3.0), std::pair(2.5, 3.0)})
        add_landmark(room_m + x_m, y_m);
  }

  bool is_one_component() const {
    JoinedLandmarks joined = joined_by_routes(graph_);
    return std::ranges::all_of(graph_.landmarks(), [&](const auto& one) { return joined.set_of(one.first) == 1; });
  }

  OccupancyGrid grid_{kCell_m};
  RobotModel robot_;
  LandmarksConfig config_;
  LandmarkGraph graph_;
  DrivenPath driven_;
  Pose2 T_map_robot_{3.0, 1.0, 0.0};
  LandmarkConnector connector_{config_, robot_};
};

TEST_F(LandmarkConnectorTest, JoinsEachPairBothWays) {
  EXPECT_EQ(connect(), 3);
  EXPECT_EQ(graph_.routes().size(), 6U);
  for (const auto& [from, to] : {std::pair(1, 2), std::pair(2, 1), std::pair(1, 3), std::pair(3, 2)})
    EXPECT_NE(graph_.route_between(from, to), nullptr);
}

// The map moves: all lies 1 m further in x and y, and what is between the first two landmarks aside of that by up to
// so much.
class MovedConnectorTest : public LandmarkConnectorTest {
 protected:
  void move(double bend_m) {
    const auto to = [&](double x_m) {
      const double part = std::clamp((x_m - 1.8) / 2.4, 0.0, 1.0);
      return Pose2{1.0, 1.0 + bend_m * std::pow(std::sin(std::numbers::pi * part), 2.0), 0.0};
    };
    std::vector<Pose2> before;
    std::vector<Pose2> after;
    for (double x_m = 0.0; x_m < 8.0; x_m += 0.1) {
      before.push_back({x_m, 2.0, 0.0});
      after.push_back(to(x_m) * before.back());
    }
    grid_ = OccupancyGrid(kCell_m);
    fill(grid_, {{0, 0}, {100, 70}}, -1000);
    for (const auto& [id, known] : graph_.landmarks()) {
      Landmark& landmark = *graph_.find(id);
      const Pose2 T = to(known.T_map_landmark.x_m);
      landmark.T_map_landmark = T * landmark.T_map_landmark;
      landmark.access = T * *landmark.access;
      const Cell at = grid_.cell_at(landmark.T_map_landmark.position());
      fill(grid_, {{at.x - 1, at.y - 1}, {at.x + 1, at.y + 1}}, 1000);
    }
    connector_.move({before, after}, graph_, [](LandmarkId) { return true; });
    T_map_robot_ = Pose2{1.0, 1.0, 0.0} * T_map_robot_;
  }
};

TEST_F(MovedConnectorTest, NothingIsPlannedAgainWhereTheMapHasMovedAsAWhole) {
  connect();
  const LandmarkGraph before = graph_;
  move(0.0);
  EXPECT_EQ(connect(), 0);
  for (const auto& [id, route] : before.routes()) {
    const Route* const moved = graph_.find_route(id);
    ASSERT_NE(moved, nullptr);
    EXPECT_NEAR((moved->trajectory.front().position() - route.trajectory.front().position() - Point(1.0, 1.0)).norm(),
                0.0, 2.0 * kMaxRounding_m);
    EXPECT_NEAR(moved->cost_m, route.cost_m, 0.05);
  }
  EXPECT_EQ(connect(), 0) << "and the next time nothing has changed";
}

TEST_F(MovedConnectorTest, WhatWasBentIsPlannedAgain) {
  connect();
  move(0.2);
  EXPECT_EQ(connect(), 0);
  graph_ = {};
  grid_ = OccupancyGrid(kCell_m);
  fill(grid_, {{0, 0}, {80, 40}}, -1000);
  for (const double x_m : {1.5, 4.5, 7.0}) add_landmark(x_m, 2.0);
  T_map_robot_ = {3.0, 1.0, 0.0};
  connector_ = LandmarkConnector(config_, robot_);
  connect();
  move(0.8);
  EXPECT_EQ(connect(), 2) << "two of three pass there";
}

TEST_F(MovedConnectorTest, WhatIsBlockedInTheNewMapIsPlannedAgain) {
  connect();
  move(0.0);
  fill(grid_, {{40, 15}, {41, 60}}, 1000);  // between the first two
  EXPECT_EQ(connect(), 2);
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
  EXPECT_EQ(graph_.routes().size(), 2U) << "L1 stands behind the wall";
  EXPECT_TRUE(graph_.find(1)->access) << "it can be approached all the same, once one is there";
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

TEST_F(LandmarkConnectorTest, ADrivenPathWithLessRoomBesideItThanThePlannedOneIsNotTaken) {
  connect();
  const Pose2 from = *graph_.find(1)->access;
  const Pose2 to = *graph_.find(2)->access;
  const Pose2 middle{(from.x_m + to.x_m) / 2, from.y_m, 0.0};
  for (double s = 0.0; s <= 1.0; s += 0.01) driven_.record({from.x_m + s * (to.x_m - from.x_m), from.y_m, 0.0});
  fill(grid_, {{28, grid_.cell_at({middle.x_m, middle.y_m + robot_.radius_m + 0.05}).y}, {29, 25}}, 1000);
  const auto by_way_of = [&](double aside_m) {
    return [&, aside_m](const PlanRequest& request) {
      PlanResult result = GridPlanner(grid_, robot_.radius_m)(request);
      const bool is_pair = *request.from.pose == from && *request.to.pose == to;
      if (is_pair) result.path = {from, {middle.x_m, middle.y_m + aside_m, 0.0}, to};
      return result;
    };
  };
  connect_by(by_way_of(-0.02));
  EXPECT_TRUE(graph_.route_between(1, 2)->driven) << "the planned path has no more room";
  LandmarkConnector connector(config_, robot_);
  connect_by(by_way_of(-0.3), connector, graph_);
  EXPECT_FALSE(graph_.route_between(1, 2)->driven);
}

TEST_F(LandmarkConnectorTest, TwoJoinedRoomsAreOneComponent) {
  make_two_rooms();
  connect();
  EXPECT_TRUE(is_one_component());
}

TEST_F(LandmarkConnectorTest, WhereTheRobotStandsDoesNotMatter) {
  connect();
  const LandmarkGraph expected = graph_;
  for (const Pose2& bad : {Pose2{0.05, 0.05, 0.0}, Pose2{1.5, 2.0, 0.0}, Pose2{-3.0, 99.0, 0.0}}) {
    LandmarkGraph graph;
    for (const auto& [id, landmark] : graph_.landmarks()) {
      Landmark fresh = landmark;
      fresh.access.reset();
      graph.add(fresh);
    }
    T_map_robot_ = bad;
    LandmarkConnector connector(config_, robot_);
    connect(connector, graph);
    EXPECT_EQ(graph, expected) << "in a corner, inside a landmark, outside the map";
  }
}

TEST_F(LandmarkConnectorTest, ARoutePastWhatThePlannerFindsNoPathThroughLeadsOverCells) {
  make_two_rooms();
  PlanResult given_up;
  given_up.outcome = PlanOutcome::out_of_budget;
  connect_by([&](const PlanRequest&) { return given_up; });
  EXPECT_TRUE(is_one_component());
  EXPECT_EQ(graph_.routes().size(), 14U) << "the spanning set alone";
  for (const auto& [id, route] : graph_.routes()) {
    EXPECT_TRUE(is_free(route.trajectory, grid_, robot_.radius_m));
    EXPECT_LT(route.trajectory.size(), 12U) << "corners that need not be are dropped";
  }
}

TEST_F(LandmarkConnectorTest, ARobotThatCannotTurnOnTheSpotIsJoinedByTheNextPairThatThePlannerCanJoin) {
  make_two_rooms();
  robot_.kinematics = Kinematics::car;
  LandmarkConnector connector(config_, robot_);
  GridPlanner planner(grid_, robot_.radius_m);
  std::set<RouteEnds> refused;
  connect_by(
      [&](const PlanRequest& request) {
        const bool through_the_door = (request.from.pose->x_m < 6.0) != (request.to.pose->x_m < 6.0);
        if (through_the_door && refused.empty()) {
          refused.insert({1, 5});
          return PlanResult{};
        }
        return planner(request);
      },
      connector, graph_);
  EXPECT_TRUE(is_one_component());
  connect_by([&](const PlanRequest&) { return PlanResult{}; }, connector, graph_);
  EXPECT_TRUE(is_one_component()) << "nothing has changed";
}

TEST_F(LandmarkConnectorTest, NoRouteGoesBeforeTheNewOnesStand) {
  config_.routes_per_landmark = 1;
  LandmarkConnector connector(config_, robot_);
  connect(connector, graph_);
  ASSERT_NE(graph_.route_between(1, 2), nullptr);
  add_landmark(3.0, 2.0);  // between the two, which are no neighbours any more
  GridPlanner planner(grid_, robot_.radius_m);
  connect_by(
      [&](const PlanRequest& request) {
        EXPECT_NE(graph_.route_between(1, 2), nullptr);
        EXPECT_NE(graph_.route_between(2, 1), nullptr);
        return planner(request);
      },
      connector, graph_);
  EXPECT_EQ(graph_.route_between(1, 2), nullptr);
  EXPECT_TRUE(is_one_component());
}

TEST_F(LandmarkConnectorTest, AFreeRouteStaysWhenThePlannerGivesUp) {
  GridPlanner planner(grid_, robot_.radius_m + 0.08);  // whose paths are free for the disc
  connect_by(std::ref(planner));
  const LandmarkGraph before = graph_;
  fill(grid_, {{20, 33}, {60, 35}}, 1000);  // no route leads there, but shorter ones might
  int asked = 0;
  PlanResult given_up;
  given_up.outcome = PlanOutcome::out_of_budget;
  LandmarkConnector resumed(config_, robot_);
  connect_by(
      [&](const PlanRequest&) {
        ++asked;
        return given_up;
      },
      resumed, graph_);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(graph_, before);
  fill(grid_, {{29, 10}, {31, 40}}, 1000);  // in the way from L1
  connect_by([&](const PlanRequest&) { return given_up; }, resumed, graph_);
  EXPECT_TRUE(is_one_component());
  for (const auto& [id, route] : graph_.routes()) EXPECT_TRUE(is_free(route.trajectory, grid_, robot_.radius_m));
}

TEST_F(LandmarkConnectorTest, ADrivenPathThatIsBlockedNowGivesWayToAPlannedOne) {
  connect();
  const Pose2 from = *graph_.find(1)->access;
  const Pose2 to = *graph_.find(2)->access;
  for (double s = 0.0; s <= 1.0; s += 0.01)
    driven_.record({from.x_m + s * (to.x_m - from.x_m), from.y_m + s * (to.y_m - from.y_m), 0.0});
  connect();
  ASSERT_TRUE(graph_.route_between(1, 2)->driven);
  fill(grid_, {{29, 12}, {31, 25}}, 1000);
  connect();
  EXPECT_FALSE(graph_.route_between(1, 2)->driven);
}

TEST_F(LandmarkConnectorTest, WhatBelongsToOtherFloorsStays) {
  Landmark upstairs;
  upstairs.T_map_landmark = {1.5, 2.0, 0.0};
  upstairs.level = 1;
  const LandmarkId lift = graph_.add(upstairs);
  Route route;
  route.from = 1;
  route.to = lift;
  route.cost_m = 4.0;
  const RouteId id = graph_.add_route(route);
  connect();
  ASSERT_NE(graph_.find_route(id), nullptr);
  EXPECT_FALSE(graph_.find(lift)->access);
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
