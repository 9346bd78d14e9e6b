#include "framework/files/robot_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

using config_test::error_of;
using config_test::TestFolder;

const std::filesystem::path kRobots = std::filesystem::path(CAIRN_SOURCE_DIR) / "config" / "robots";

RobotModel load_text(const std::string& text) {
  const TestFolder folder;
  return load_robot(folder.write("r.yaml", text));
}

std::string error_in(const std::string& text) {
  const TestFolder folder;
  const auto file = folder.write("r.yaml", text);
  return folder.without_folder(error_of([&] { (void)load_robot(file); }));
}

TEST(RobotFile, EveryShippedRobotLoads) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kRobots)) {
    SCOPED_TRACE(entry.path());
    const RobotModel robot = load_robot(entry.path());
    EXPECT_FALSE(robot.name.empty());
    // The beams of recorded lasers come with their logs; some have a laser alone.
    const std::string stem = entry.path().stem();
    const bool has_lasers_alone = stem == "laser_robot" || stem == "lego_robot" || stem.starts_with("turtlebot3") ||
                                  stem == "pioneer3dx_laser_camera";
    EXPECT_EQ(robot.sonars.empty(), has_lasers_alone);
    EXPECT_EQ(robot.firing_period_s, 0.04);
    EXPECT_EQ(robot.firing_order.size(), robot.sonars.size());
    for (const SonarModel& sonar : robot.sonars) {
      EXPECT_DOUBLE_EQ(sonar.half_beam_rad, radians(15.0));
      EXPECT_EQ(sonar.min_m, 0.1);
      EXPECT_EQ(sonar.max_m, 5.0);
    }
    ++files;
  }
  EXPECT_GE(files, 3);
}

TEST(RobotFile, ThePioneer1IsAsMeasured) {
  const RobotModel robot = load_robot(kRobots / "pioneer1.yaml");
  EXPECT_EQ(robot.radius_m, 0.22);
  EXPECT_EQ(robot.max_v_mps, 0.4);
  EXPECT_DOUBLE_EQ(robot.max_w_radps, radians(100.0));
  EXPECT_EQ(robot.kinematics, Kinematics::differential);
  ASSERT_EQ(robot.sonars.size(), 7U);
  EXPECT_EQ(robot.sonars[1].T_robot_sonar, (Pose2{0.12, 0.08, radians(30.0)}));
  EXPECT_EQ(robot.sonars[6].T_robot_sonar, (Pose2{0.1, -0.1, radians(-90.0)}));
  EXPECT_EQ(robot.odometry_error.distance_ratio, 0.01);
  EXPECT_EQ(robot.odometry_error.distance_bias_ratio, 0.0);
  EXPECT_DOUBLE_EQ(robot.odometry_error.heading_rad_per_m, radians(0.5));
  EXPECT_DOUBLE_EQ(robot.compass_error.noise_rad, radians(2.0));
  EXPECT_EQ(robot.compass_error.local_bias_rad, 0.0);
}

TEST(RobotFile, TheWornPioneer1DiffersInItsErrorsOnly) {
  const RobotModel robot = load_robot(kRobots / "pioneer1.yaml");
  const RobotModel worn = load_robot(kRobots / "pioneer1_worn.yaml");
  EXPECT_EQ(worn.odometry_error.distance_ratio, 0.03);
  EXPECT_GT(worn.odometry_error.distance_bias_ratio, 0.0);
  EXPECT_DOUBLE_EQ(worn.odometry_error.heading_rad_per_m, radians(2.0));
  EXPECT_DOUBLE_EQ(worn.compass_error.noise_rad, radians(2.0));
  EXPECT_DOUBLE_EQ(worn.compass_error.local_bias_rad, radians(5.0));
  ASSERT_EQ(worn.sonars.size(), robot.sonars.size());
  for (std::size_t i = 0; i < robot.sonars.size(); ++i) {
    EXPECT_EQ(worn.sonars[i].T_robot_sonar, robot.sonars[i].T_robot_sonar);
  }
  EXPECT_EQ(worn.radius_m, robot.radius_m);
}

TEST(RobotFile, ThePioneer3DxSeesAllRound) {
  const RobotModel robot = load_robot(kRobots / "pioneer3dx.yaml");
  EXPECT_EQ(robot.radius_m, 0.25);
  ASSERT_EQ(robot.sonars.size(), 16U);
  // The listing is symmetric: sonar 7 - i mirrors sonar i, and 23 - i mirrors i at the back.
  for (std::size_t i = 0; i < 16; ++i) {
    const Pose2& left = robot.sonars[i].T_robot_sonar;
    const Pose2& right = robot.sonars[i < 8 ? 7 - i : 23 - i].T_robot_sonar;
    EXPECT_EQ(left.x_m, right.x_m) << i;
    EXPECT_EQ(left.y_m, -right.y_m) << i;
    EXPECT_DOUBLE_EQ(left.theta_rad, -right.theta_rad) << i;
  }
}

TEST(RobotFile, ThePioneer3DxWithALaserIsThePioneer3DxBesides) {
  const RobotModel plain = load_robot(kRobots / "pioneer3dx.yaml");
  const RobotModel robot = load_robot(kRobots / "pioneer3dx_laser.yaml");
  EXPECT_EQ(robot.sonars.size(), plain.sonars.size());
  EXPECT_TRUE(plain.lasers.empty());
  ASSERT_EQ(robot.lasers.size(), 1U);
  EXPECT_EQ(robot.lasers[0].beams, 181);
  EXPECT_NEAR(degrees(robot.lasers[0].step_rad()), 1.0, 1e-9);
  EXPECT_EQ(first_beam_of(robot, 0), 16);
  EXPECT_EQ(reading_period_s(robot), 0.04) << "of its sonars";
  EXPECT_EQ(farthest_range_m(robot), 8.0);
}

TEST(RobotFile, TheTurtleBot3HasALaserAllRound) {
  const RobotModel robot = load_robot(kRobots / "turtlebot3.yaml");
  ASSERT_EQ(robot.lasers.size(), 1U);
  EXPECT_EQ(robot.lasers[0].beams, 360);
  EXPECT_NEAR(degrees(robot.lasers[0].T_robot_beam(359).theta_rad), 179.0, 1e-9);
  EXPECT_EQ(reading_period_s(robot), 0.2);
  EXPECT_EQ(farthest_range_m(robot), 3.5);
}

TEST(RobotFile, ALaserNeedsOnlyItsPlace) {
  const RobotModel robot = load_text("name: a\nradius_m: 1\nlasers:\n  - {x_m: 0.1, y_m: -0.2, angle_deg: 180}\n");
  ASSERT_EQ(robot.lasers.size(), 1U);
  const LaserModel& laser = robot.lasers[0];
  EXPECT_NEAR(laser.T_robot_laser.theta_rad, radians(180.0), 1e-12);
  EXPECT_EQ(laser.beams, LaserModel{}.beams);
  EXPECT_NEAR(degrees(laser.T_robot_beam(0).theta_rad), 90.0, 1e-9) << "the first one, seen from behind";
  EXPECT_EQ(laser.noise_m, 0.01);
  EXPECT_EQ(laser.dropped_ratio, 0.0);
}

TEST(RobotFile, ThePioneer3DxWithACameraIsThePioneer3DxBesides) {
  const RobotModel plain = load_robot(kRobots / "pioneer3dx.yaml");
  const RobotModel robot = load_robot(kRobots / "pioneer3dx_camera.yaml");
  EXPECT_EQ(robot.sonars.size(), plain.sonars.size());
  EXPECT_EQ(robot.radius_m, plain.radius_m);
  EXPECT_EQ(robot.odometry_error.heading_rad_per_m, plain.odometry_error.heading_rad_per_m);
  EXPECT_TRUE(plain.cameras.empty());
  ASSERT_EQ(robot.cameras.size(), 1U);
  EXPECT_EQ(robot.cameras[0].T_robot_camera, (Pose2{0.1, 0.0, 0.0}));
  EXPECT_EQ(robot.cameras[0].height_m, 0.3);
}

TEST(RobotFile, ACameraNeedsOnlyItsPlaceAndItsFocalLength) {
  const RobotModel robot = load_text(
      "name: a\nradius_m: 1\ncameras:\n"
      "  - {x_m: 0.1, y_m: -0.2, height_m: 0.5, focal_px: [300, 310], width_px: 320, height_px: 240}\n"
      "  - {x_m: 0, y_m: 0, height_m: 1, focal_px: [1, 1], angle_deg: 270, tilt_deg: -10, centre_px: [300, 200],\n"
      "     distortion: [-0.2, 0.05], rate_hz: 30}\n");
  ASSERT_EQ(robot.cameras.size(), 2U);
  const CameraModel& plain = robot.cameras[0];
  EXPECT_EQ(plain.T_robot_camera, (Pose2{0.1, -0.2, 0.0}));
  EXPECT_EQ(plain.focal_x_px, 300.0);
  EXPECT_EQ(plain.focal_y_px, 310.0);
  EXPECT_EQ(plain.centre_x_px, 159.5) << "the middle of its picture, whatever that of another size is";
  EXPECT_EQ(plain.centre_y_px, 119.5);
  EXPECT_EQ(plain.tilt_rad, 0.0);
  EXPECT_EQ(plain.distortion, (std::array<double, 5>{}));
  const CameraModel& other = robot.cameras[1];
  EXPECT_NEAR(other.T_robot_camera.theta_rad, radians(-90.0), 1e-12);
  EXPECT_NEAR(other.tilt_rad, radians(-10.0), 1e-12);
  EXPECT_EQ(other.centre_x_px, 300.0);
  EXPECT_EQ(other.distortion, (std::array<double, 5>{-0.2, 0.05, 0.0, 0.0, 0.0}));
  EXPECT_EQ(other.rate_hz, 30.0);
}

TEST(RobotFile, SaysWhatIsWrongWithACamera) {
  const auto camera_error = [](const std::string& more) {
    return error_in("name: a\nradius_m: 1\ncameras:\n  - {x_m: 0, y_m: 0, height_m: 1, " + more + "}\n");
  };
  EXPECT_EQ(camera_error("focal_px: [500]"), "r.yaml:4:45: focal_px must be two numbers [x, y], found 1");
  EXPECT_EQ(camera_error("focal_px: [1, 1], centre_px: [1, 2, 3]"),
            "r.yaml:4:64: centre_px must be two numbers [x, y], found 3");
  EXPECT_EQ(camera_error("focal_px: [1, 1], width_px: 100, height_px: 50, centre_px: [99, 50]"),
            "r.yaml:4:94: centre_px must lie in the picture of 100 x 50 pixels, found [99, 50]");
  EXPECT_EQ(camera_error("focal_px: [1, 1], distortion: [0, 0, 0, 0, 0, 0]"),
            "r.yaml:4:65: distortion has 5 numbers at most (k1, k2, p1, p2, k3), found 6");
  EXPECT_THAT(camera_error("rate_hz: 5"), testing::StartsWith("r.yaml:4:5: cameras lacks the key \"focal_px\""));
  EXPECT_THAT(camera_error("focal: [1, 1]"), testing::HasSubstr("did you mean \"focal_px\"?"));
  EXPECT_THAT(camera_error("focal_px: [0, 1]"),
              testing::StartsWith("r.yaml:4:46: each item of focal_px must be a number"));
}

TEST(RobotFile, SaysWhatIsWrongWithALaser) {
  const std::string begin = "name: a\nradius_m: 1\nlasers:\n  - ";
  EXPECT_EQ(error_in(begin + "{x_m: 0, y_m: 0, min_m: 4, max_m: 4}\n"),
            "r.yaml:4:5: min_m must be less than max_m, found 4 and 4");
  EXPECT_EQ(error_in(begin + "{x_m: 0, y_m: 0, first_angle_deg: -200, last_angle_deg: 180}\n"),
            "r.yaml:4:5: first_angle_deg and last_angle_deg must be more than 0 and at most 360 deg apart, found -200 "
            "and 180");
  EXPECT_EQ(error_in(begin + "{x_m: 0, y_m: 0, beams: 3000}\n  - {x_m: 0, y_m: 0, beams: 1097}\n"),
            "r.yaml:5:5: sonars and beams together may be 4096 at most, found 4097");
  EXPECT_EQ(error_in(begin + "{x_m: 0, y_m: 0, beams: 0}\n"),
            "r.yaml:4:29: beams must be a whole number from 1 to 4096, found \"0\"");
  EXPECT_THAT(error_in(begin + "{x_m: 0, y_m: 0, rate: 10}\n"),
              testing::StartsWith("r.yaml:4:22: unknown key \"rate\" in lasers (did you mean \"rate_hz\"?)"));
  EXPECT_THAT(error_in(begin + "{y_m: 0}\n"), testing::StartsWith("r.yaml:4:5: lasers lacks the key \"x_m\""));
}

TEST(RobotFile, LittleIsNeeded) {
  const RobotModel robot = load_text("name: disc\nradius_m: 0.3\n");
  const RobotModel defaults;
  EXPECT_EQ(robot.radius_m, 0.3);
  EXPECT_EQ(robot.max_v_mps, defaults.max_v_mps);
  EXPECT_EQ(robot.max_w_radps, defaults.max_w_radps);
  EXPECT_EQ(robot.max_acceleration_mps2, defaults.max_acceleration_mps2);
  EXPECT_EQ(robot.max_turn_acceleration_radps2, defaults.max_turn_acceleration_radps2);
  EXPECT_EQ(robot.firing_period_s, defaults.firing_period_s);
  EXPECT_EQ(robot.range_error.noise_m, defaults.range_error.noise_m);
  EXPECT_EQ(robot.compass_error.local_bias_scale_m, defaults.compass_error.local_bias_scale_m);
  EXPECT_TRUE(robot.firing_order.empty());
}

TEST(RobotFile, WithoutACompassInItTheRobotHasNone) {
  EXPECT_FALSE(load_text("name: disc\nradius_m: 0.3\n").has_compass);
  EXPECT_TRUE(load_text("name: disc\nradius_m: 0.3\ncompass: {noise_deg: 2}\n").has_compass);
}

TEST(RobotFile, APolygonIsEnclosedByItsRadius) {
  const RobotModel robot = load_text(
      "name: box\npolygon_m: [[-0.1, -0.2], [-0.1, 0.2], [0.3, 0.2], [0.3, -0.2]]\nkinematics: car\n"
      "limits: {min_turning_radius_m: 0.5}\n");
  ASSERT_EQ(robot.polygon_m.size(), 4U);
  EXPECT_DOUBLE_EQ(robot.radius_m, std::hypot(0.3, 0.2));
  EXPECT_EQ(robot.kinematics, Kinematics::car);
  EXPECT_EQ(robot.min_turning_radius_m, 0.5);
  EXPECT_EQ(robot.polygon_m[0], Point(0.3, -0.2)) << "anticlockwise, in the robot's own frame";
}

TEST(RobotFile, SaysWhatIsWrong) {
  EXPECT_EQ(error_in("radius_m: 0.2\n"), "r.yaml:1:1: robot lacks the key \"name\": what people call it");
  EXPECT_EQ(error_in(""), "r.yaml:1:1: robot lacks the key \"name\": what people call it");
  EXPECT_EQ(error_in("name: a\n"), "r.yaml:1:1: robot needs one of radius_m, polygon_m");
  EXPECT_EQ(error_in("name: a\nradius_m: 1\npolygon_m: []\n"),
            "r.yaml:3:1: robot takes only one of radius_m, polygon_m, found both \"radius_m\" and \"polygon_m\"");
  EXPECT_EQ(error_in("name: a\nradius_m: -1\n"),
            "r.yaml:2:11: radius_m must be a number from 0.01 to 10 m, found \"-1\"");
  EXPECT_EQ(error_in("name: a\npolygon_m: [[0, 0], [1, 0]]\n"),
            "r.yaml:2:12: polygon_m: a polygon needs at least 3 corners, this one has 2");
  EXPECT_EQ(error_in("name: a\nradius_m: 1\nkinematics: tracked\n"),
            "r.yaml:3:13: kinematics must be one of differential, car, found \"tracked\"");
  EXPECT_EQ(
      error_in("name: a\nradius_m: 1\nlimits: {max_v: 1}\n"),
      "r.yaml:3:10: unknown key \"max_v\" in limits (did you mean \"max_v_mps\"?); known: max_v_mps, max_w_degps, "
      "max_acceleration_mps2, max_turn_acceleration_degps2, min_turning_radius_m");
  EXPECT_EQ(error_in("name: a\nradius_m: 1\nlimits: {max_w_degps: 0}\n"),
            "r.yaml:3:23: max_w_degps must be a number from 1 to 1000 deg/s, found \"0\"");
}

TEST(RobotFile, SaysWhatIsWrongWithItsMotion) {
  EXPECT_EQ(error_in("name: a\nradius_m: 1\nkinematics: car\n"),
            "r.yaml:1:1: a car needs limits: {min_turning_radius_m: ...} above 0");
  EXPECT_EQ(error_in("name: a\nradius_m: 1\nkinematics: car\nlimits: {max_v_mps: 1}\n"),
            "r.yaml:4:9: a car needs limits: {min_turning_radius_m: ...} above 0");
  EXPECT_EQ(
      error_in("name: a\nradius_m: 1\nlimits: {min_turning_radius_m: 1}\n"),
      "r.yaml:3:32: min_turning_radius_m is for \"kinematics: car\" only; a differential robot turns on the spot");
}

TEST(RobotFile, SaysWhatIsWrongWithItsSonars) {
  const std::string head = "name: a\nradius_m: 1\nsonars:\n";
  EXPECT_EQ(error_in(head + "  - {x_m: 0, y_m: 0}\n"),
            "r.yaml:4:5: sonars lacks the key \"angle_deg\": beam axis, anticlockwise from ahead");
  EXPECT_EQ(error_in(head + "  - {x_m: 100, y_m: 0, angle_deg: 0}\n"),
            "r.yaml:4:11: x_m must be a number from -10 to 10 m, found \"100\"");
  EXPECT_EQ(error_in(head + "  - {x_m: 0, y_m: 0, angle_deg: 0}\n  - {x_m: 0, y_m: 0, angle_deg: 0, min_m: 6}\n"),
            "r.yaml:5:5: min_m must be less than max_m, found 6 and 5");
  EXPECT_EQ(error_in(head + "  - {x_m: 0, y_m: 0, angle_deg: 0}\nfiring: {order: [0, 1]}\n"),
            "r.yaml:5:21: each item of order must be a whole number from 0 to 0, found \"1\"");
  EXPECT_EQ(error_in("name: a\nradius_m: 1\nfiring: {order: [0]}\n"),
            "r.yaml:3:18: order names a sonar, but the robot has none");
  EXPECT_EQ(error_in("name: a\nradius_m: 1\nfiring: {order: 0}\n"), "r.yaml:3:17: order must be a list, found \"0\"");
  EXPECT_EQ(error_in("name: a\nradius_m: 1\nfiring: {period_s: -1}\n"),
            "r.yaml:3:20: period_s must be a number from 0 to 10 s, found \"-1\"");
}

}  // namespace
}  // namespace cairn
