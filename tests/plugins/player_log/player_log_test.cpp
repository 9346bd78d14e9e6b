#include "plugins/player_log/player_log.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "tests/plugins/log_files.hpp"

namespace cairn::player_log {
namespace {

using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::string kOdometry = "5 0 6665 position2d 00 001 001 +01.000 +02.000 +0.500 0 0 0 0\n";
const std::string kGeometry = "5 0 6665 sonar 00 004 001 2 +00.100 +00.200 +01.5000 +00.100 -00.200 -01.5000 \n";
const std::string kRanges = "6 0 6665 sonar 00 001 001 2 1.250 4.000 \n";

class PlayerLog : public ::testing::Test {
 protected:
  std::vector<Observation> play(const std::string& text) {
    config_.file = folder_.write("a.log", text);
    log_common::ScanPlayer player(read_player_log(config_, robot_));
    start_ = player.start();
    return log_files::play(player, reason_);
  }
  std::string fault_of(const std::string& text) {
    try {
      play(text);
      return reason_;
    } catch (const ConfigError& error) {
      return folder_.without_folder(error.what());
    }
  }

  log_files::LogFolder folder_;
  Config config_;
  RobotModel robot_;
  std::optional<Pose2> start_;
  std::string reason_;
};

TEST_F(PlayerLog, ReadsSonarsWithTheirGeometryAndTheOdometryBeforeThem) {
  const auto seen = play("## Player version 2.0.5\n## File version: 0.3.0\n" + kGeometry + kOdometry + kRanges +
                         "7 0 6665 position2d 00 001 001 +02.000 +02.000 +0.500 0 0 0 0\n7 0 6665 sonar 00 001 001 2 "
                         "0.05 -1 \n7 0 6665 power 00 001 001 12.1\n");
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_DOUBLE_EQ(seen[0].stamp_s, 6.0);
  EXPECT_EQ(start_, (Pose2{1.0, 2.0, 0.5}));
  ASSERT_EQ(seen[0].ranges.size(), 2U);
  EXPECT_EQ(seen[0].ranges[0].T_robot_sensor, (Pose2{0.1, 0.2, 1.5}));
  EXPECT_DOUBLE_EQ(seen[0].ranges[0].range_m, 1.25);
  EXPECT_DOUBLE_EQ(seen[0].ranges[0].half_beam_rad, radians(15));
  EXPECT_EQ(seen[0].ranges[1].sensor, 1);
  EXPECT_EQ(seen[1].ranges[0].range_m, -kInfinity);
  EXPECT_TRUE(std::isnan(seen[1].ranges[1].range_m));
  EXPECT_NEAR(seen[1].T_odom_robot.x_m, std::cos(0.5), 1e-12);
  EXPECT_EQ(reason_, "end of a.log after 2 observations; 1 line of kinds not read: \"power:1:1\" 1");
}

TEST_F(PlayerLog, WithoutAGeometryTheRobotsSonarsServe) {
  const std::string text = kOdometry + kRanges;
  EXPECT_EQ(fault_of(text), "a.log:2:27: 2 ranges, but no sonar geometry so far, and the robot file has 0 sonars");
  robot_.sonars.resize(2);
  robot_.sonars[1].T_robot_sonar = {0.3, 0.0, 0.0};
  EXPECT_EQ(play(text)[0].ranges[1].T_robot_sensor, (Pose2{0.3, 0.0, 0.0}));
}

TEST_F(PlayerLog, ReadsALaserScanWhereTheLogSaysTheLaserSits) {
  const auto seen =
      play(kOdometry + "5 0 6665 laser 00 004 001 +0.100 +0.000 0.000 0.15 0.15\n" +
           "6 0 6665 laser 00 001 001 0001 -1.5708 +1.5708 +1.57080000 +08.0000 0003 1.0 0 2.0 1 8.19 0\n");
  ASSERT_EQ(seen.size(), 1U);
  ASSERT_EQ(seen[0].ranges.size(), 3U);
  EXPECT_DOUBLE_EQ(seen[0].ranges[0].T_robot_sensor.theta_rad, -1.5708);
  EXPECT_NEAR(seen[0].ranges[0].T_robot_sensor.x_m, 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(seen[0].ranges[1].range_m, 2.0);
  EXPECT_EQ(seen[0].ranges[2].range_m, kInfinity);
}

TEST_F(PlayerLog, ReadsOneDeviceOfAKindAndOnlyTheInterfacesItIsGiven) {
  const std::string other = "6 0 6665 sonar 01 001 001 1 1.0\n";
  EXPECT_EQ(play(kGeometry + kOdometry + kRanges + other).size(), 1U);
  EXPECT_THAT(reason_, HasSubstr("\"sonar:1:1\" 1"));
  config_.interfaces = {"laser"};
  EXPECT_THAT(fault_of(kGeometry + kOdometry + kRanges), HasSubstr("holds no observation"));
  config_.interfaces = {"sonnar"};
  EXPECT_EQ(fault_of(kRanges), "a.log: interfaces: no ranges are read from \"sonnar\" (did you mean \"sonar\"?)");
}

TEST_F(PlayerLog, RangesBeforeAnyPoseAreTakenWhereTheFirstOneIs) {
  const auto seen = play(kGeometry + kRanges + kOdometry + kRanges);
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].T_odom_robot, Pose2{});
  EXPECT_EQ(seen[1].T_odom_robot, Pose2{});
}

TEST_F(PlayerLog, ReadsScansWithPosesAndRangersWithManyRangesAsLasers) {
  const auto seen =
      play(kOdometry + "6 0 6665 laser 00 001 002 0001 +1 +2 +0.5 -0.5 +0.5 +1.0 +8.0 0002 1.0 0 2.0 1\n");
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].T_odom_robot, Pose2{}) << "of position2d";
  EXPECT_DOUBLE_EQ(seen[0].ranges[1].T_robot_sensor.theta_rad, 0.5);
  EXPECT_EQ(seen[0].ranges[1].range_m, 2.0);
  std::string many = "7 0 6665 ranger 00 001 001 0541";
  for (int i = 0; i < 541; ++i) many += " 1.5";
  const auto ranger =
      play(kOdometry + "5 0 6665 ranger 00 004 001 0.1 0 0 0 0 0 0.2 0.2 0.2 0000 0000\n" + many + "\n");
  ASSERT_EQ(ranger.size(), 1U);
  EXPECT_NEAR(ranger[0].ranges[0].T_robot_sensor.theta_rad, radians(-135.0), 1e-9) << "the usual laser with 541 beams";
  EXPECT_NEAR(ranger[0].ranges[0].T_robot_sensor.x_m, 0.1, 1e-9);
  const auto configured =
      play(kOdometry + "5 0 6665 ranger 00 004 005 -1.0 1.0 0.0037 0.1 12.0 0.01 10\n" + many + "\n");
  EXPECT_NEAR(configured[0].ranges[0].T_robot_sensor.theta_rad, -1.0, 1e-9);
  EXPECT_EQ(configured[0].ranges[0].max_m, 12.0);
  EXPECT_THAT(fault_of(kOdometry + "7 0 6665 ranger 00 001 001 2 1 2\n"), HasSubstr("holds no observation"));
}

TEST_F(PlayerLog, BadLinesAreRefusedAtTheirPlace) {
  const std::string head = kGeometry + kOdometry;
  EXPECT_EQ(fault_of(head + "6 0 6665 sonar 00 001 001 3 1.0 2.0\n"),
            "a.log:3:27: 3 ranges, says the line, but 2 words follow, not 3");
  EXPECT_EQ(fault_of(head + "6 0 6665 sonar\n"),
            "a.log:3:15: the line ends before its payload: time host robot interface index type subtype payload");
  EXPECT_EQ(fault_of(head + std::string(2U << 20U, '7') + "\n"),
            "a.log:3:1: the line is longer than 1048576 characters");
  EXPECT_EQ(fault_of("## File version: 0.2.2\n" + head + kRanges),
            "a.log:1:1: a Player log of file version \"0.2.2\"; 0.3.0 can be read");
  const std::string packed = folder_.gzip(head + kRanges);
  EXPECT_THAT(fault_of(packed.substr(0, packed.size() - 5)), HasSubstr("the compressed log is cut off here"));
}

TEST_F(PlayerLog, ReadsTheSmallLogOfTheConformanceSuite) {
  config_.file = std::string(CAIRN_SOURCE_DIR) + "/tests/data/player.log";
  log_common::ScanPlayer player(read_player_log(config_, robot_));
  EXPECT_EQ(log_files::play(player, reason_).size(), 20U);
  EXPECT_EQ(
      reason_,
      "end of player.log after 20 observations; 11 lines of kinds not read: \"position2d:4:1\" 1 \"power:1:1\" 10");
}

TEST_F(PlayerLog, RandomlyBrokenLogsNeverCrash) {
  config_.on_bad_line = log_common::BadLine::skip;
  const std::string good =
      kGeometry + kOdometry + kRanges + "6 0 1 laser 00 001 001 1 -1.57 +1.57 +1.57 +08.0 3 1.0 0 2.0 1 8.19 0\n";
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    std::string text = good;
    for (int i = 0; i < 4; ++i) text[random() % text.size()] = " 0123456789.-e+\nnaF#"[random() % 20];
    (void)fault_of(text);
  }
}

}  // namespace
}  // namespace cairn::player_log
