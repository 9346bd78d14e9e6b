#include "plugins/carmen_log/carmen_log.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "tests/plugins/log_files.hpp"

namespace cairn::carmen_log {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class CarmenLog : public ::testing::Test {
 protected:
  std::vector<Observation> play(const std::string& text) {
    config_.file = folder_.write("a.log", text);
    log_common::ScanPlayer player(read_carmen_log(config_));
    start_ = player.start();
    return log_files::play(player, reason_);
  }
  // A FLASER line of n ranges with a pose and an odometry.
  static std::string flaser(const std::string& ranges, const std::string& poses, double time_s = 1.0) {
    return "FLASER " + ranges + " " + poses + " " + std::to_string(time_s) + " host 2.5\n";
  }

  log_files::LogFolder folder_;
  Config config_;
  std::optional<Pose2> start_;
  std::string reason_;
};

TEST_F(CarmenLog, ReadsALaserLine) {
  const auto seen = play("# message formats defined: PARAM ODOM FLASER\nODOM 0 0 0 0 0 0 0.1 host 0.1\nNEFF 3\n" +
                         flaser("3 1.5 2 90", "1 2 0.5 7 8 0.25", 12.5) + "SYNC x\n" +
                         flaser("3 0.01 -1 nan", "2 2 0.5 7 8 0.25", 13));
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_DOUBLE_EQ(seen[0].stamp_s, 12.5);
  ASSERT_EQ(seen[0].ranges.size(), 3U);
  EXPECT_DOUBLE_EQ(seen[0].ranges[0].range_m, 1.5);
  EXPECT_DOUBLE_EQ(seen[0].ranges[0].T_robot_sensor.theta_rad, radians(-90));
  EXPECT_NEAR(seen[0].ranges[1].T_robot_sensor.theta_rad, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(seen[0].ranges[2].T_robot_sensor.theta_rad, radians(90));
  EXPECT_EQ(seen[0].ranges[2].range_m, kInfinity) << "beyond 80 m";
  EXPECT_EQ(seen[0].ranges[2].sensor, 2);
  EXPECT_EQ(seen[0].ranges[0].half_beam_rad, 0.0) << "a ray";
  EXPECT_EQ(seen[1].ranges[0].range_m, -kInfinity) << "nearer than min_m";
  EXPECT_TRUE(std::isnan(seen[1].ranges[1].range_m) && std::isnan(seen[1].ranges[2].range_m));
  EXPECT_EQ(start_, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_EQ(seen[0].T_odom_robot, Pose2{});
  EXPECT_NEAR(seen[1].T_odom_robot.x_m, std::cos(0.5), 1e-12);
  EXPECT_FALSE(seen[0].compass_rad.has_value());
  EXPECT_EQ(reason_, "end of a.log after 2 observations; 1 line of kinds not read: \"NEFF\" 1");
}

TEST_F(CarmenLog, TakesTheOdometryBesideThePoseWhenAskedTo) {
  config_.poses = Poses::odometry;
  config_.compass_from_pose = true;
  const auto seen = play(flaser("1 1", "1 2 0.5 7 8 0.25") + flaser("1 1", "1 2 0.5 7 9 0.75", 2));
  EXPECT_EQ(start_, (Pose2{7.0, 8.0, 0.25}));
  EXPECT_NEAR(seen[1].T_odom_robot.y_m, std::cos(0.25), 1e-12);
  EXPECT_DOUBLE_EQ(seen[1].compass_rad.value(), 0.75);
}

// Angle of the first and of the last of n beams, degrees.
TEST_F(CarmenLog, SpreadsTheUsualCountsOfBeamsFromMinusNinety) {
  const auto fan = [&](int n) {
    std::string ranges = std::to_string(n);
    for (int i = 0; i < n; ++i) ranges += " 1";
    const auto seen = play(flaser(ranges, "0 0 0 0 0 0"));
    return std::pair(std::round(degrees(seen[0].ranges.front().T_robot_sensor.theta_rad) * 100) / 100,
                     std::round(degrees(seen[0].ranges.back().T_robot_sensor.theta_rad) * 100) / 100);
  };
  EXPECT_EQ(fan(180), std::pair(-90.0, 89.0));
  EXPECT_EQ(fan(181), std::pair(-90.0, 90.0));
  EXPECT_EQ(fan(360), std::pair(-90.0, 89.5));
  EXPECT_EQ(fan(361), std::pair(-90.0, 90.0));
  EXPECT_EQ(fan(91), std::pair(-90.0, 90.0));
  EXPECT_EQ(fan(1), std::pair(-90.0, -90.0));
  config_.laser.first_angle_rad = radians(-45);
  config_.laser.step_rad = radians(0.25);
  EXPECT_EQ(fan(181), std::pair(-45.0, 0.0));
}

TEST_F(CarmenLog, ParamsPlaceTheLasersAndLimitTheirRange) {
  const auto seen = play(
      "PARAM robot_frontlaser_offset 0.2 nohost 0\nPARAM robot_rearlaser_offset -0.3 nohost 0\n"
      "PARAM robot_front_laser_max 8 nohost 0\n" +
      flaser("1 8.5", "5 0 0 4.8 0 0") + "RLASER 1 8.5 4.5 0 3.14159265358979 4.8 0 0 1 host 1\n");
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_NEAR(seen[0].ranges[0].T_robot_sensor.x_m, 0.2, 1e-12);
  EXPECT_EQ(seen[0].ranges[0].range_m, kInfinity) << "the front laser's maximum";
  EXPECT_NEAR(seen[1].ranges[0].T_robot_sensor.x_m, -0.3, 1e-12);
  EXPECT_NEAR(seen[1].ranges[0].T_robot_sensor.theta_rad, radians(90), 1e-12) << "-90 deg seen from behind";
  EXPECT_DOUBLE_EQ(seen[1].ranges[0].range_m, 8.5);
  EXPECT_NE(seen[0].ranges[0].sensor, seen[1].ranges[0].sensor);
  EXPECT_NEAR(start_->x_m, 4.8, 1e-12) << "the robot is behind its laser";
  EXPECT_NEAR(seen[1].T_odom_robot.position().norm(), 0.0, 1e-9) << "both lasers give the same robot pose";
}

TEST_F(CarmenLog, ReadsBothVariantsOfRobotLaser) {
  const std::string head = "ROBOTLASER1 0 -0.5 1 0.5 20 0.01 0 3 1 2 25 ";
  const std::string poses = "1.1 2 0 1 2 0 0.3 0 0.5 0.5";
  for (const std::string& line : {head + poses + " 7.5 host 1\n",                      // as the older header says
                                  head + "0 " + poses + " 1e5 7.5 host 1\n",           // no remissions, turn axis
                                  head + "3 9 9 9 " + poses + " 0.0 7.5 host 1\n"}) {  // remissions, turn axis
    const auto seen = play(line);
    ASSERT_EQ(seen.size(), 1U) << line;
    EXPECT_DOUBLE_EQ(seen[0].stamp_s, 7.5);
    EXPECT_NEAR(seen[0].ranges[0].T_robot_sensor.theta_rad, -0.5, 1e-12);
    EXPECT_NEAR(seen[0].ranges[2].T_robot_sensor.theta_rad, 0.5, 1e-12);
    EXPECT_NEAR(seen[0].ranges[0].T_robot_sensor.x_m, 0.1, 1e-12) << "the line says where the laser is";
    EXPECT_EQ(seen[0].ranges[2].range_m, kInfinity) << "beyond the line's maximum range";
    EXPECT_NEAR(start_->x_m, 1.0, 1e-12);
  }
}

TEST_F(CarmenLog, SonarsStandWhereTheLastPoseWas) {
  config_.sonar.max_m = 3.0;
  const auto seen = play(
      "ODOM 1 1 0 0 0 0 1 host 1\nSONAR 0.5 2 1.25 4 0.1 0.2 1.5 0.1 -0.2 -1.5 1 host 1\n"
      "ODOM 2 1 0 0 0 0 2 host 2\nSONAR 0.5 2 0.01 2 0.1 0.2 1.5 0.1 -0.2 -1.5 2 host 2\n");
  ASSERT_EQ(seen.size(), 2U);
  const RangeReading& first = seen[0].ranges[0];
  EXPECT_EQ(first.T_robot_sensor, (Pose2{0.1, 0.2, 1.5}));
  EXPECT_DOUBLE_EQ(first.half_beam_rad, 0.25) << "the cone angle is the whole cone";
  EXPECT_DOUBLE_EQ(first.range_m, 1.25);
  EXPECT_EQ(seen[0].ranges[1].range_m, kInfinity);
  EXPECT_EQ(seen[1].ranges[0].range_m, -kInfinity);
  EXPECT_EQ(seen[1].T_odom_robot, (Pose2{1.0, 0.0, 0.0}));
  EXPECT_EQ(seen[1].ranges[1].sensor, 1);
}

TEST_F(CarmenLog, ReadsOnlyTheKindsItIsGiven) {
  const std::string text = flaser("1 1", "0 0 0 0 0 0") + "SONAR 0.5 1 1.25 0 0 0 2 host 1\n";
  EXPECT_EQ(play(text).size(), 2U);
  config_.lines = {"SONAR"};
  EXPECT_EQ(play(text).size(), 1U) << "the laser line still says where the robot is";
}

TEST_F(CarmenLog, MarksOfNoEchoAndWhatTheyMean) {
  config_.no_echo = {32.77};
  const std::string text = flaser("2 32.77 5", "0 0 0 0 0 0");
  EXPECT_EQ(play(text)[0].ranges[0].range_m, kInfinity);
  config_.no_echo_means = log_common::NoEcho::nothing;
  EXPECT_TRUE(std::isnan(play(text)[0].ranges[0].range_m));
  EXPECT_DOUBLE_EQ(play(text)[0].ranges[1].range_m, 5.0);
}

TEST_F(CarmenLog, ReadsTheRecordedIntelLog) {
  const char* data = std::getenv("CAIRN_DATA");
  const auto folder = data != nullptr ? std::filesystem::path(data)
                                      : std::filesystem::path(CAIRN_SOURCE_DIR).parent_path() / "shared" / "data";
  config_.file = folder / "laser_carmen" / "intel-corrected.log.gz";
  if (!std::filesystem::exists(config_.file)) GTEST_SKIP() << "no data folder";
  log_common::ScanPlayer player(read_carmen_log(config_));
  const auto seen = log_files::play(player, reason_);
  ASSERT_EQ(seen.size(), 910U);
  EXPECT_EQ(seen[0].ranges.size(), 180U);
  EXPECT_EQ(player.start(), (Pose2{0.600266, -0.0320327, -0.354665}));
  EXPECT_EQ(
      reason_,
      "end of intel-corrected.log.gz after 910 observations; 910 lines of kinds not read: \"NEFF\" 910; the odometry "
      "of all 910 laser lines equals their pose: the log is not corrected, or its odometry was replaced by the "
      "corrected poses, on which no localizer can be tried; 4 clock jumps bridged, the first at line 5647");
}

}  // namespace
}  // namespace cairn::carmen_log
