#include "plugins/submap_graph/submap_graph.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/plugins/submap_graph/driven_ring.hpp"
#include "tests/plugins/submap_graph/usual_closer.hpp"

namespace cairn::submap_graph {
namespace {

RangeReading reading(double bearing_rad, double range_m, double half_beam_rad = 0.0) {
  return {{0.0, 0.0, bearing_rad}, half_beam_rad, 0.05, 80.0, range_m, 0};
}

KnownMap nothing_known() {
  static const OccupancyGrid grid(0.05);
  static const LandmarkGraph landmarks;
  return {grid, landmarks};
}

TEST(GatherPoints, TakesEchoesOfNarrowBeamsWithinReachOneASquare) {
  const double infinity = std::numeric_limits<double>::infinity();
  Observation seen;
  seen.ranges = {reading(0.0, 2.0),  reading(0.0, 2.001),        reading(1.0, 3.0, 0.3), reading(2.0, infinity),
                 reading(2.0, 40.0), reading(2.0, std::nan("")), reading(2.0, 80.0),     reading(2.0, -infinity)};
  std::vector<Point> points_m;
  gather_points(seen, {}, points_m);
  ASSERT_EQ(points_m.size(), 1U);
  EXPECT_NEAR((points_m[0] - Point(2.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(SubmapGraph, CorrectsThePastWhenALoopCloses) {
  const std::vector<DrivenScan> drive = ring_drive(1, radians(3.0), 0.05);
  const std::vector<DrawnWall> walls = ring_walls();
  SubmapGraph localizer({}, drive.front().T_map_robot, usual_closer());
  std::uint64_t seed = 0;
  for (const DrivenScan& scan : drive) {
    Observation seen;
    seen.T_odom_robot = scan.T_odom_robot;
    for (const Point& point_m : seen_from(walls, scan.T_map_robot, 120, 0.01, ++seed))
      seen.ranges.push_back(reading(std::atan2(point_m.y(), point_m.x()), point_m.norm()));
    const PoseEstimate estimate = localizer.update(seen, nothing_known());
    EXPECT_LT((estimate.T_map_robot.position() - scan.T_map_robot.position()).norm(), 0.6);
  }
  PoseHistory* history = localizer.history();
  ASSERT_NE(history, nullptr);
  while (history->finish_part()) {
  }
  const std::vector<Pose2> poses = history->poses();
  ASSERT_EQ(poses.size(), drive.size());
  for (std::size_t i = 0; i < drive.size(); ++i)
    EXPECT_LT((poses[i].position() - drive[i].T_map_robot.position()).norm(), 0.1) << i;
}

// A third of the round each time, while the robot drives on and turns.
TEST(SubmapGraph, PartsOfALasersRoundAreOneScan) {
  Config config;
  config.sweep_s = 0.3;
  SubmapGraph localizer(config, {1.0, 1.0, 0.0}, usual_closer());
  const std::vector<DrawnWall> walls = ring_walls();
  Pose2 truth{1.0, 1.0, 0.0};
  Pose2 T_odom_robot;
  int scans = 0;
  for (std::uint64_t i = 0; i < 150; ++i) {
    Observation seen;
    seen.stamp_s = 0.1 * static_cast<double>(i);
    seen.T_odom_robot = T_odom_robot;
    const std::vector<Point> round = seen_from(walls, truth, 180, 0.01, i + 1);
    for (std::size_t k = (i % 3) * round.size() / 3; k < (i % 3 + 1) * round.size() / 3; ++k)
      seen.ranges.push_back(reading(std::atan2(round[k].y(), round[k].x()), round[k].norm()));
    const PoseEstimate estimate = localizer.update(seen, nothing_known());
    scans += estimate.sightings_used + estimate.sightings_refused;
    ASSERT_LT((estimate.T_map_robot.position() - truth.position()).norm(), 0.2) << i << "; odometry: 0.6 m in the end";
    const Pose2 next{0.04, 0.0, i / 25 % 4 == 0 || i / 25 % 4 == 3 ? 0.02 : -0.02};
    truth = truth * next;
    T_odom_robot = T_odom_robot * Pose2{1.1 * next.x_m, 0.0, 1.2 * next.theta_rad};
  }
  EXPECT_EQ(scans, 50);
}

TEST(SubmapGraph, OdometryThatIsNotFiniteIsAStepOfNone) {
  SubmapGraph localizer({}, {1.0, 2.0, 0.0}, nullptr);
  Observation seen;
  (void)localizer.update(seen, nothing_known());
  seen.T_odom_robot = {std::nan(""), 0.0, 0.0};
  EXPECT_EQ(localizer.update(seen, nothing_known()).T_map_robot, (Pose2{1.0, 2.0, 0.0}));
  seen.T_odom_robot = {0.1, 0.0, 0.0};
  EXPECT_NEAR(localizer.update(seen, nothing_known()).T_map_robot.x_m, 1.1, 1e-9);
}

std::string error_of(const std::string& settings) {
  try {
    (void)load_config<Config>(parse_config_text(settings, "m.yaml"), "plugin submap_graph");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SubmapGraphConfig, SettingsOfTheSearchForLoopsSayWhereTheyAreNow) {
  EXPECT_EQ(error_of("{min_score: 0.6}"),
            "m.yaml:1:2: the key \"min_score\" in plugin submap_graph is now `loop_closer.min_score`");
  EXPECT_EQ(error_of("{field_sigma_m: 0.15}"),
            "m.yaml:1:2: the key \"field_sigma_m\" in plugin submap_graph is now `loop_closer.field_sigma_m`, and here "
            "`search_sigma_m` for the search around odometry");
  EXPECT_EQ(error_of("{submap_m: 8}"), "no error");
}

}  // namespace
}  // namespace cairn::submap_graph
