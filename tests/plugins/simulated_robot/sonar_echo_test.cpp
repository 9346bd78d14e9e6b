#include "plugins/simulated_robot/sonar_echo.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "maps/geometry/segments.hpp"
#include "tests/plugins/simulated_robot/test_worlds.hpp"

namespace cairn {
namespace {

using testing::circle_at;
using testing::room;
using testing::square_at;
using testing::tilted_wall;
using testing::wall;

constexpr double kHalfBeam_rad = radians(15.0);

// The first echo in metres of a sonar at a pose, or infinity.
double echo(const World& world, const Pose2& T_map_sonar = {}, const EchoConfig& config = {},
            double half_beam_rad = kHalfBeam_rad) {
  const Scene scene(world);
  return SonarEcho(config, scene, half_beam_rad)
      .first_echo(T_map_sonar, 5.0)
      .value_or(std::numeric_limits<double>::infinity());
}

TEST(SonarEcho, ReadsASmoothWallAheadAtItsExactDistance) {
  EXPECT_DOUBLE_EQ(echo(tilted_wall(2.0, 0.0)), 2.0);
  EXPECT_DOUBLE_EQ(echo(tilted_wall(2.0, 0.0, Surface::rough)), 2.0);
  EXPECT_DOUBLE_EQ(echo(tilted_wall(4.9, 0.0)), 4.9);
}

TEST(SonarEcho, HearsNothingInAnEmptyWorldAndNothingBeyondItsReach) {
  EXPECT_TRUE(std::isinf(echo(World{})));
  EXPECT_TRUE(std::isinf(echo(tilted_wall(5.01, 0.0))));
  EXPECT_TRUE(std::isinf(echo(tilted_wall(-1.0, 0.0)))) << "a wall behind";
}

TEST(SonarEcho, ReadsThePerpendicularOfASmoothWallInsideTheMainLobe) {
  for (const double tilt_deg : {-8.0, -3.0, 5.0, 8.0}) {
    EXPECT_NEAR(echo(tilted_wall(2.0, tilt_deg)), 2.0 * std::cos(radians(tilt_deg)), 1e-12) << tilt_deg;
  }
}

TEST(SonarEcho, HearsATiltedSmoothWallInTheSideLobesOnlyWhenItIsClose) {
  EXPECT_NEAR(echo(tilted_wall(1.2, 20.0)), 1.2 * std::cos(radians(20.0)), 1e-12) << "first side lobe";
  EXPECT_GT(echo(tilted_wall(2.8, 20.0)), 2.8) << "first side lobe, too far";
  EXPECT_NEAR(echo(tilted_wall(0.6, 35.0)), 0.6 * std::cos(radians(35.0)), 1e-12) << "second side lobe";
  EXPECT_GT(echo(tilted_wall(1.2, 35.0)), 1.2) << "second side lobe, too far";
}

TEST(SonarEcho, LosesASmoothWallAtFortyFiveDegreesButNotARoughOne) {
  EXPECT_TRUE(std::isinf(echo(tilted_wall(2.0, 45.0))));
  const double rough_m = echo(tilted_wall(2.0, 45.0, Surface::rough));
  // Its near side as far as the main lobe reaches; the perpendicular foot at 1.41 m is out of the beam.
  EXPECT_GT(rough_m, 1.6);
  EXPECT_LT(rough_m, 2.0);
}

TEST(SonarEcho, ReadsTheWholeWayOfARayThatBouncesOffASmoothWall) {
  // The beam meets a mirror at (2, 0) that turns it upwards to a wall 1.5 m on, seen head on.
  World world = tilted_wall(2.0, 45.0);
  world.walls.push_back(wall({{-1.0, -1.5}, {5.0, -1.5}}, Surface::smooth));
  EXPECT_NEAR(echo(world), 3.5, 0.02);
  EchoConfig no_bounces;
  no_bounces.max_bounces = 0;
  EXPECT_TRUE(std::isinf(echo(world, {}, no_bounces)));
}

TEST(SonarEcho, ReadsACylinderAtItsNearestPointWhereverItIsInTheBeam) {
  for (const Surface surface : {Surface::smooth, Surface::rough}) {
    for (const double bearing_deg : {-10.0, 0.0, 7.0}) {
      World world;
      const Point at_m(2.0 * std::cos(radians(bearing_deg)), 2.0 * std::sin(radians(bearing_deg)));
      world.objects = {circle_at(at_m, 0.5, surface)};
      EXPECT_NEAR(echo(world), 1.75, 1e-12) << bearing_deg;
    }
  }
}

TEST(SonarEcho, AnswersASmoothCylinderFromEverySide) {
  World world;
  world.objects = {circle_at({1.0, 1.0}, 0.4, Surface::smooth)};
  for (int angle_deg = 0; angle_deg < 360; angle_deg += 7) {
    const double a = radians(angle_deg);
    const Pose2 T_map_sonar{1.0 - 1.5 * std::cos(a), 1.0 - 1.5 * std::sin(a), wrap_angle(a)};
    EXPECT_NEAR(echo(world, T_map_sonar), 1.3, 1e-9) << angle_deg;
  }
}

TEST(SonarEcho, HearsACornerFromOutsideWeakly) {
  World world;
  world.objects = {square_at({0.0, 0.0}, 0.6, 45.0, Surface::smooth)};
  const double corner_m = std::sqrt(0.18);
  EXPECT_NEAR(echo(world, {-corner_m - 1.5, 0.0, 0.0}), 1.5, 1e-9);
  EXPECT_TRUE(std::isinf(echo(world, {-corner_m - 4.0, 0.0, 0.0}))) << "too weak from afar";
}

TEST(SonarEcho, HearsTheEndOfAWallThatShowsNoFace) {
  World world;
  world.walls = {wall({{1.0, 0.0}, {4.0, 0.0}})};
  EXPECT_NEAR(echo(world), 1.0, 1e-12);
}

TEST(SonarEcho, HearsASquareInnerCornerFromAfar) {
  // Both walls of the room stand at 45 deg to the axis: only the corner sends the beam back.
  const Pose2 T_map_sonar{3.0 - std::sqrt(2.0), 3.0 - std::sqrt(2.0), radians(45.0)};
  EXPECT_NEAR(echo(room(3.0, 3.0), T_map_sonar), 2.0, 1e-9);
}

TEST(SonarEcho, TakesTheNearestOfSeveralEchoesAndNothingThatIsHidden) {
  World world = tilted_wall(3.0, 0.0);
  world.objects = {circle_at({2.0, 0.2}, 0.2)};
  EXPECT_NEAR(echo(world), std::hypot(2.0, 0.2) - 0.1, 1e-9);
  world.walls.push_back(wall({{1.5, -1.0}, {1.5, 1.0}}));
  EXPECT_NEAR(echo(world), 1.5, 1e-12);
}

TEST(SonarEcho, NeverReadsShorterThanTheNearestPointOfTheWorld) {
  World world = room(4.0, 3.0);
  world.objects = {circle_at({2.0, 1.5}, 0.5), square_at({3.0, 0.8}, 0.5, 20.0)};
  const Scene scene(world);
  const SonarEcho sonar({}, scene, kHalfBeam_rad);
  int echo_range = 0;
  for (int i = 0; i < 500; ++i) {
    const Point at_m(0.3 + 3.4 * std::fmod(i * 0.618034, 1.0), 0.3 + 2.4 * std::fmod(i * 0.754878, 1.0));
    double nearest_m = 1e9;
    for (const Face& face : scene.faces())
      nearest_m = std::min(nearest_m, distance_to_segment_m(at_m, face.a_m, face.b_m));
    nearest_m = std::min(nearest_m, (at_m - Point(2.0, 1.5)).norm() - 0.25);
    if (nearest_m < 0.0) continue;
    const auto way_m = sonar.first_echo({at_m.x(), at_m.y(), wrap_angle(radians(37.0 * i))}, 5.0);
    EXPECT_GE(way_m.value_or(nearest_m), nearest_m - 1e-9) << at_m.transpose();
    echo_range += way_m.has_value();
  }
  EXPECT_GT(echo_range, 350);
}

TEST(SonarEcho, IsAPlainRayWithoutABeamAngle) {
  EXPECT_DOUBLE_EQ(echo(tilted_wall(2.0, 45.0), {}, {}, 0.0), 2.0);
  World beside;
  beside.objects = {circle_at({2.0, 0.2}, 0.3)};
  EXPECT_TRUE(std::isinf(echo(beside, {}, {}, 0.0)));
}

TEST(Scene, DistinguishesInnerCornersFromEdgesAndFromStraightWalls) {
  const auto look = [](const World& world, const Point& vertex, const Point& eye) {
    const Scene scene(world);
    for (const Vertex& v : scene.vertices()) {
      if ((v.at_m - vertex).norm() < 1e-6) return v.look_from(eye);
    }
    throw std::logic_error("no such vertex");
  };
  const World square_room = room(4.0, 4.0);
  EXPECT_EQ(look(square_room, {0, 0}, {1, 1}), VertexLook::square_corner);
  EXPECT_EQ(look(square_room, {0, 0}, {-1, -1}), VertexLook::edge);
  EXPECT_EQ(look(room(4.0, 4.0, Surface::rough), {0, 0}, {1, 1}), VertexLook::nothing);
  World straight;
  straight.walls = {wall({{0, 0}, {1, 0}, {2, 0}})};
  EXPECT_EQ(look(straight, {1, 0}, {1, 1}), VertexLook::nothing);
  EXPECT_EQ(look(straight, {2, 0}, {3, 0}), VertexLook::edge);
  World built_on;
  built_on.walls = {wall({{0, 0}, {4, 0}}), wall({{2, 0}, {2, 3}})};
  EXPECT_EQ(look(built_on, {2, 0}, {1, 1}), VertexLook::square_corner);
  EXPECT_EQ(look(built_on, {2, 0}, {3, 1}), VertexLook::square_corner);
  EXPECT_EQ(look(built_on, {2, 0}, {2, -1}), VertexLook::nothing);
}

TEST(Scene, LetsNoRaySlipThroughACorner) {
  const Scene scene(room(3.0, 2.0));
  for (int i = 0; i < 3600; ++i) {
    const double a = radians(0.1 * i);
    EXPECT_TRUE(std::isfinite(scene.cast({1.0, 1.0}, {std::cos(a), std::sin(a)}, 100.0).distance_m)) << i;
  }
  EXPECT_TRUE(std::isfinite(scene.cast({1.0, 1.0}, Point(1, 1).normalized(), 100.0).distance_m));
  EXPECT_TRUE(std::isfinite(scene.cast({1.5, 1.0}, Point(1.5, 1).normalized(), 100.0).distance_m));
}

}  // namespace
}  // namespace cairn
