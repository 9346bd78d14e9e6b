#include "plugins/lego_log/lego_log.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "tests/plugins/log_files.hpp"

namespace cairn::lego_log {
namespace {

using ::testing::HasSubstr;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const char* const kMotors = "M 1000 100 100 0 0 200 200 0\nM 2000 1100 1100 0 0 1200 1200 0\n";

class LegoLog : public ::testing::Test {
 protected:
  LegoLog() { config_.wheels = {0.001, 0.2}; }

  std::vector<Observation> play(const std::string& scans, const std::string& motors = kMotors) {
    config_.file = folder_.write("scan.txt", scans);
    config_.motors = folder_.write("motors.txt", motors);
    log_common::ScanPlayer player(read_lego_log(config_, 0.5));
    EXPECT_EQ(player.start(), std::nullopt) << "the mission says where the robot begins";
    return log_files::play(player, reason_);
  }
  std::string fault_of(const std::string& scans, const std::string& motors = kMotors) {
    try {
      play(scans, motors);
      return folder_.without_folder(reason_);
    } catch (const ConfigError& error) {
      return folder_.without_folder(error.what());
    }
  }

  log_files::LogFolder folder_;
  Config config_;
  std::string reason_;
};

TEST_F(LegoLog, ReadsScansWithTheOdometryOfTheirTime) {
  const auto seen = play("S 1250 3 500 600 700\nS 1750 3 510 610 710\n");
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_DOUBLE_EQ(seen[0].stamp_s, 1.25);
  EXPECT_EQ(seen[0].T_odom_robot, Pose2{}) << "counted from the first scan";
  EXPECT_NEAR(seen[1].T_odom_robot.x_m, 0.5, 1e-12);
  EXPECT_EQ(seen[0].compass_rad, std::nullopt);
  ASSERT_EQ(seen[1].ranges.size(), 3U);
  EXPECT_DOUBLE_EQ(seen[1].ranges[2].range_m, 0.71);
  EXPECT_EQ(reason_, "end of scan.txt after 2 observations");
}

TEST_F(LegoLog, RangesFollowTheLaserAndItsCalibration) {
  config_.laser.x_m = 0.03;
  config_.laser.first_angle_rad = radians(-10.0);
  config_.laser.step_rad = radians(10.0);
  config_.laser.min_m = 0.02;
  config_.laser.max_m = 4.0;
  config_.range_ratio = 1.1;
  config_.range_offset_m = 0.05;
  const auto seen = play("S 1000 5 1000 15 -3 4500 3990\n");
  EXPECT_EQ(seen[0].ranges[0].T_robot_sensor, (Pose2{0.03, 0.0, radians(-10.0)}));
  EXPECT_NEAR(seen[0].ranges[0].range_m, 1.15, 1e-12);
  EXPECT_EQ(seen[0].ranges[1].range_m, -kInfinity) << "15 mm is how this laser says that it has no echo";
  EXPECT_TRUE(std::isnan(seen[0].ranges[2].range_m));
  EXPECT_EQ(seen[0].ranges[3].range_m, kInfinity);
  EXPECT_EQ(seen[0].ranges[4].range_m, 4.0) << "never beyond what the laser can measure";
}

TEST_F(LegoLog, TheOdometrysHeadingServesAsACompassWhenAsked) {
  config_.compass_from_pose = true;
  const auto seen = play("S 1000 1 500\nS 2000 1 500\n", "M 1000 0 0 0 0 0 0\nM 2000 0 -100 0 0 0 100\n");
  EXPECT_DOUBLE_EQ(seen[0].compass_rad.value(), 0.5);
  EXPECT_NEAR(seen[1].compass_rad.value(), 0.5, 1e-12) << "the left wheel's count is the third word";
}

TEST_F(LegoLog, ReadsGzipAndCountsLinesOfOtherKinds) {
  EXPECT_EQ(play(folder_.gzip("S 1000 1 500\n\nP 1000 5 5\n"), folder_.gzip(kMotors)).size(), 1U);
  EXPECT_EQ(reason_, "end of scan.txt after 1 observations; 1 line of kinds not read: \"P\" 1");
}

TEST_F(LegoLog, BadScansAreRefusedAtTheirPlace) {
  EXPECT_EQ(fault_of("S 1 2 500 600\nS 2 2 500\n"), "scan.txt:2:5: the line holds 1 ranges, not \"2\"");
  EXPECT_EQ(fault_of("S 1 0\n"), "scan.txt:1:5: the line holds 0 ranges, not \"0\"");
  EXPECT_EQ(fault_of("S 1\n"), "scan.txt:1:4: the line ends where the number of ranges must be");
  EXPECT_EQ(fault_of("S 1 1 oops\n"), "scan.txt:1:7: the range must be a number, not \"oops\"");
  EXPECT_EQ(play("S 1 1 150000\n")[0].ranges[0].range_m, kInfinity) << "150 m is far, not wrong";
  EXPECT_EQ(fault_of("S nan 1 5\n"), "scan.txt:1:3: the time stamp must be finite, not \"nan\"");
  EXPECT_EQ(fault_of("S 1 1 5\nS 2 2 5 6\n"), "scan.txt:2:5: the scans before had 1 ranges, not \"2\"");
  EXPECT_EQ(fault_of(""), "scan.txt: the log holds no observation");
  const std::string packed = folder_.gzip("S 1000 1 500\n");
  EXPECT_EQ(fault_of(packed.substr(0, packed.size() - 3)), "scan.txt:2:1: the compressed log is cut off here");
  config_.motors = "/none";
  config_.file = folder_.write("scan.txt", "");
  EXPECT_THROW((void)read_lego_log(config_, 0.0), ConfigError);
}

TEST_F(LegoLog, BadMotorsAreRefusedAtTheirPlace) {
  const std::string good = "S 1000 1 500\n";
  EXPECT_EQ(fault_of(good, "M 1000 5 0 0 0\n"), "motors.txt:1:15: the line ends where the right wheel's ticks must be");
  EXPECT_EQ(fault_of(good, "M 1000 1e99 0 0 0 1\n"),
            "motors.txt:1:8: the left wheel's ticks are beyond 1e12: \"1e99\"");
  EXPECT_EQ(fault_of(good, "M 2 5 0 0 0 1\nM 1 5 0 0 0 1\n"), "motors.txt:2:3: the motors' time goes back to \"1\"");
  EXPECT_EQ(fault_of(good, good), "motors.txt: the log holds no line of the motors");
}

TEST_F(LegoLog, BadLinesAreSkippedAndCountedWhenAsked) {
  config_.on_bad_line = log_common::BadLine::skip;
  EXPECT_THAT(fault_of("S 1000 1 x\nS 1100 1 500\n"),
              HasSubstr("after 1 observations; 1 bad line skipped, the first: scan.txt:1:10: "));
}

TEST_F(LegoLog, AClockThatGoesBackIsBridged) {
  const auto seen = play("S 2000 1 500\nS 1000 1 500\n");
  EXPECT_GE(seen[1].stamp_s, seen[0].stamp_s);
  EXPECT_THAT(reason_, HasSubstr("1 clock jump bridged, the first at line 2"));
}

TEST_F(LegoLog, ReadsTheDriveBetweenTheCylinders) {
  const char* data = std::getenv("CAIRN_DATA");
  const auto folder = (data != nullptr ? std::filesystem::path(data)
                                       : std::filesystem::path(CAIRN_SOURCE_DIR).parent_path() / "shared" / "data") /
                      "landmarks" / "lego_cylinders";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no data folder: lego_cylinders";
  config_.file = folder / "robot4_scan.txt.gz";
  config_.motors = folder / "robot4_motors.txt";
  config_.wheels = Wheels{0.000349, 0.173};
  log_common::ScanPlayer player(read_lego_log(config_, 0.0));
  const auto seen = log_files::play(player, reason_);
  ASSERT_EQ(seen.size(), 278U);
  EXPECT_EQ(seen[0].ranges.size(), 660U);
  // The overhead camera saw the robot end at (0.596, 1.765), having begun at (1.850, 1.897), 213 deg.
  const Pose2 T_map_mark{1.850, 1.897, radians(213.0)};
  const Pose2 T_robot_mark{0.03, 0.0, 0.0};
  const Pose2 end = T_map_mark * inverse(T_robot_mark) * seen.back().T_odom_robot * T_robot_mark;
  EXPECT_LT((end.position() - Point(0.596, 1.765)).norm(), 0.25) << end.x_m << ", " << end.y_m;
}

}  // namespace
}  // namespace cairn::lego_log
