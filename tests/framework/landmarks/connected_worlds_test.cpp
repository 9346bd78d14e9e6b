// Over random worlds: the graph has a way between two landmarks whenever the grid has.

#include <gtest/gtest.h>

#include <optional>
#include <set>

#include "framework/landmarks/approach_poses.hpp"
#include "framework/landmarks/connector.hpp"
#include "maps/base/portable_random.hpp"
#include "maps/grid/swept_disc.hpp"
#include "maps/landmarks/joined_landmarks.hpp"
#include "tests/framework/landmarks/connecting.hpp"
#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

constexpr Cell kSize{46, 34};

// Rooms behind walls with doors of any width, or none, with pillars and patches that nobody has seen.
OccupancyGrid random_rooms(PortableRandom& random) {
  OccupancyGrid grid(0.1);
  fill(grid, {{0, 0}, kSize}, -1000);
  for (int walls = random.whole(1, 2); walls > 0; --walls) {
    const int x = random.whole(8, kSize.x - 8);
    fill(grid, {{x, 0}, {x + 1, kSize.y}}, 1000);
    const int door = random.whole(1, kSize.y - 12);
    fill(grid, {{x, door}, {x + 1, door + random.whole(0, 10)}}, -1000);
  }
  if (random.share() < 0.7) {
    const int y = random.whole(8, kSize.y - 8);
    fill(grid, {{0, y}, {kSize.x, y + 1}}, 1000);
    for (int doors = random.whole(0, 3); doors > 0; --doors) {
      const int door = random.whole(0, kSize.x - 10);
      fill(grid, {{door, y}, {door + random.whole(2, 9), y + 1}}, -1000);
    }
  }
  for (int pillars = random.whole(0, 6); pillars > 0; --pillars) {
    const Cell at{random.whole(0, kSize.x - 3), random.whole(0, kSize.y - 3)};
    fill(grid, {at, at + Cell{random.whole(1, 3), random.whole(1, 3)}}, random.share() < 0.7 ? 1000 : 0);
  }
  return grid;
}

// Which cells a disc drives to from a place over cell centres, straight from the grid: the oracle.
std::set<Cell> flood(const OccupancyGrid& grid, const Point& from, double radius_m) {
  const auto is_free = [&](Cell a, Cell b) {
    return sweep_is_free(grid, {}, grid.centre_of(a), grid.centre_of(b), radius_m);
  };
  std::set<Cell> reached;
  std::vector<Cell> open;
  const Cell first = grid.cell_at(from);
  if (is_free(first, first)) open.push_back(first);
  while (!open.empty()) {
    const Cell at = open.back();
    open.pop_back();
    if (!reached.insert(at).second) continue;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (const Cell next = at + Cell{x, y}; !reached.contains(next) && is_free(at, next)) open.push_back(next);
  }
  return reached;
}

bool has_free_place(const OccupancyGrid& grid, const Point& landmark, double radius_m) {
  const CellBox box = grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      const Point at = grid.centre_of({x, y});
      if ((at - landmark).norm() < kApproachReach_m && sweep_is_free(grid, {}, at, at, radius_m)) return true;
    }
  return false;
}

class RandomWorld {
 public:
  explicit RandomWorld(std::uint64_t seed) : random_(seed), grid_(random_rooms(random_)) {
    robot_.radius_m = 0.16 + 0.02 * random_.whole(0, 7);
    config_.routes_per_landmark = random_.whole(1, 3);
    for (int landmarks = random_.whole(3, 8); landmarks > 0; --landmarks)
      add_landmark(graph_, grid_, 0.1 * random_.whole(2, kSize.x - 2), 0.1 * random_.whole(2, kSize.y - 2));
    for (int poses = random_.whole(0, 3); poses > 0; --poses) driven_.record(any_pose());
    connector_.emplace(config_, robot_);
  }

  // By a planner that keeps more distance than the robot needs, so that narrow doors are closed to it, and gives up now
  // and then. The robot stands anywhere, inside a wall if need be.
  void connect() {
    PoseEstimate pose;
    pose.T_map_robot = any_pose();
    const WorldView world{grid_, graph_, robot_, pose};
    GridPlanner planner(grid_, robot_.radius_m + 0.08);
    const auto plan = [&](const PlanRequest& request) {
      if (random_.share() >= 0.2) return planner(request);
      PlanResult given_up;
      given_up.outcome = PlanOutcome::out_of_budget;
      return given_up;
    };
    connector_->connect(graph_, driven_, world, plan, 1);
  }

  void change() {
    const Cell at{random_.whole(0, kSize.x - 6), random_.whole(0, kSize.y - 6)};
    fill(grid_, {at, at + Cell{random_.whole(1, 6), random_.whole(1, 6)}}, random_.share() < 0.5 ? 1000 : -1000);
  }

  // The graph against the oracle; the number of pieces that the grid has.
  int check() {
    JoinedLandmarks joined = joined_by_routes(graph_);
    std::set<LandmarkId> seen;
    int pieces = 0;
    for (const auto& [id, landmark] : graph_.landmarks()) {
      EXPECT_EQ(landmark.access.has_value(),
                has_free_place(grid_, landmark.T_map_landmark.position(), robot_.radius_m + kMaxRounding_m));
      if (!landmark.access || seen.contains(id)) continue;
      ++pieces;
      const std::set<Cell> reached = flood(grid_, landmark.access->position(), robot_.radius_m + kMaxRounding_m);
      for (const auto& [other_id, other] : graph_.landmarks()) {
        if (!other.access) continue;
        const bool on_grid = reached.contains(grid_.cell_at(other.access->position()));
        if (!on_grid) continue;
        seen.insert(other_id);
        EXPECT_TRUE(joined.are_joined(id, other_id)) << "L" << id << ", L" << other_id << drawing_of(grid_);
      }
    }
    check_routes();
    return pieces;
  }

 private:
  Pose2 any_pose() { return {0.1 * random_.whole(0, kSize.x), 0.1 * random_.whole(0, kSize.y), 0.0}; }

  // Each leads back, too, from approach pose to approach pose, and is free.
  void check_routes() const {
    for (const auto& [id, route] : graph_.routes()) {
      EXPECT_NE(graph_.route_between(route.to, route.from), nullptr);
      const Point from = graph_.find(route.from)->access->position();
      const Point to = graph_.find(route.to)->access->position();
      EXPECT_NEAR((route.trajectory.front().position() - from).norm(), 0.0, 2 * kMaxRounding_m);
      EXPECT_NEAR((route.trajectory.back().position() - to).norm(), 0.0, 2 * kMaxRounding_m);
      for (std::size_t i = 0; i < route.trajectory.size(); ++i) {
        const Point before = route.trajectory[i == 0 ? 0 : i - 1].position();
        EXPECT_TRUE(sweep_is_free(grid_, {}, before, route.trajectory[i].position(), robot_.radius_m))
            << "route " << id << drawing_of(grid_);
      }
    }
  }

  PortableRandom random_;
  OccupancyGrid grid_;
  RobotModel robot_;
  LandmarksConfig config_;
  LandmarkGraph graph_;
  DrivenPath driven_;
  std::optional<LandmarkConnector> connector_;
};

TEST(ConnectedWorlds, TheGraphHasAWayBetweenTwoLandmarksWheneverTheGridHas) {
  int in_one_piece = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    RandomWorld world(seed);
    world.connect();
    in_one_piece += world.check() == 1 ? 1 : 0;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(in_one_piece, 40);
  EXPECT_LT(in_one_piece, 160);
}

TEST(ConnectedWorlds, SoItHasAfterEachChangeOfTheGrid) {
  for (std::uint64_t seed = 301; seed <= 330; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    RandomWorld world(seed);
    for (int step = 0; step < 5; ++step) {
      world.connect();
      world.check();
      if (testing::Test::HasFailure()) return;
      world.change();
    }
  }
}

}  // namespace
}  // namespace cairn
