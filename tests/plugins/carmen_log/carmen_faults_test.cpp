// Bad input: a stated rule for each, at its place, and never a crash.
#include <gmock/gmock.h>

#include <random>

#include "plugins/carmen_log/carmen_log.hpp"
#include "tests/plugins/log_files.hpp"

namespace cairn::carmen_log {
namespace {

using ::testing::HasSubstr;

const std::string kGood = "FLASER 2 1 2 0 0 0 0 0 0 1 host 1\n";

class CarmenFaults : public ::testing::Test {
 protected:
  std::string fault_of(const std::string& bytes, const std::string& name = "a.log") {
    config_.file = folder_.write(name, bytes);
    try {
      log_common::ScanPlayer player(read_carmen_log(config_));
      std::string reason;
      seen_ = log_files::play(player, reason).size();
      return folder_.without_folder(reason);
    } catch (const ConfigError& error) {
      return folder_.without_folder(error.what());
    }
  }

  log_files::LogFolder folder_;
  Config config_;
  std::size_t seen_ = 0;
};

TEST_F(CarmenFaults, AHeadingThatIsNoAngleIsRefused) {
  EXPECT_THAT(fault_of("ODOM 0 0 1e300 0 0 0 1 h 1\n"), testing::HasSubstr("a.log:1:10: the heading is not an angle"));
}

TEST_F(CarmenFaults, CountsThatDisagreeAreRefusedAtTheCount) {
  EXPECT_EQ(fault_of(kGood + "FLASER 3 1 2 0 0 0 0 0 0 1 host 1\n"),
            "a.log:2:8: 3 ranges, says the line, but 11 words follow, not 12");
  EXPECT_EQ(fault_of("FLASER 1000000 1 2\n"),
            "a.log:1:8: 1000000 ranges, says the line, but 2 words follow, not 1000009");
  EXPECT_EQ(fault_of("FLASER 99999999 1 2\n"),
            "a.log:1:8: the count of ranges must be a whole number from 0 to 1000000, not \"99999999\"");
  EXPECT_EQ(fault_of("FLASER -1\n"),
            "a.log:1:8: the count of ranges must be a whole number from 0 to 1000000, not \"-1\"");
  EXPECT_EQ(fault_of("FLASER\n"), "a.log:1:7: the line ends where the count of ranges must be");
  EXPECT_THAT(fault_of("ROBOTLASER1 0 -1 2 1 20 0 0 2 1 1 3 9 9 0 0 0 0 0 0 0 0 0 0 0 7 host 1\n"),
              HasSubstr("a.log:1:29: 2 ranges, says the line, but"))
      << "three remissions said, two given";
  EXPECT_EQ(fault_of("ODOM 0 0 0\nSONAR 0.5 2 1 1 0 0 0 1 host 1\n"),
            "a.log:2:11: 2 sonars, says the line, but 8 words follow, not 11");
}

TEST_F(CarmenFaults, NumbersThatAreNoneAreRefusedAtTheWord) {
  EXPECT_EQ(fault_of("FLASER 2 1 x 0 0 0 0 0 0 1 host 1\n"), "a.log:1:12: the range must be a number, not \"x\"");
  EXPECT_EQ(fault_of("FLASER 1 1 0 nan 0 0 0 0 1 host 1\n"), "a.log:1:14: the y must be finite, not \"nan\"");
  EXPECT_EQ(fault_of("FLASER 1 1 0 0 0 0 0 0 later host 1\n"), "a.log:1:24: the time must be a number, not \"later\"");
  EXPECT_EQ(fault_of("ODOM 1e9 0 0\n"), "a.log:1:6: the x is beyond 100 km: \"1e9\"");
}

TEST_F(CarmenFaults, RangesBeyondAllPlacesAreNoEcho) {
  config_.file = folder_.write("a.log", "FLASER 4 1 1e300 3.4e38 1.#INF 0 0 0 0 0 0 2 host 1\n");
  log_common::ScanPlayer player(read_carmen_log(config_));
  std::string reason;
  const auto seen = log_files::play(player, reason);
  EXPECT_EQ(seen[0].ranges[0].range_m, 1.0);
  for (const std::size_t i : {1U, 2U, 3U})
    EXPECT_EQ(seen[0].ranges[i].range_m, std::numeric_limits<double>::infinity());
}

// Laser lines of a robot that drives 0.1 m from one to the next, with a pose and the odometry beside it.
std::string driven(int lines, double odometry_ratio) {
  std::string text;
  for (int i = 0; i < lines; ++i) {
    const std::string x = std::to_string(0.1 * i);
    text += "FLASER 2 1 2 " + x + " 0 0 " + std::to_string(odometry_ratio * 0.1 * i) + " 0 0 " + std::to_string(i) +
            " host 1\n";
  }
  return text;
}

TEST_F(CarmenFaults, ALogWithoutPosesIsWarnedOf) {
  EXPECT_EQ(fault_of(driven(12, 1.0)).find("same pose"), std::string::npos);
  std::string text;
  for (int i = 0; i < 12; ++i) text += "FLASER 2 1 2 0 0 0 0 0 0 " + std::to_string(i) + " host 1\n";
  EXPECT_EQ(
      fault_of(text),
      "end of a.log after 12 observations; all observations have the same pose: the log holds no poses, or the "
      "robot stood still; where it drove, `localizer: {plugin: scan_to_map}` estimates them from a laser's scans");
  EXPECT_EQ(fault_of(kGood + kGood + kGood), "end of a.log after 3 observations") << "too few to judge";
}

TEST_F(CarmenFaults, OdometryThatEqualsThePosesIsWarnedOf) {
  const std::string warning =
      "end of a.log after 12 observations; the odometry of all 12 laser lines equals their pose: the log is not "
      "corrected, or its odometry was replaced by the corrected poses, on which no localizer can be tried";
  EXPECT_EQ(fault_of(driven(12, 1.0)), warning);
  config_.poses = Poses::odometry;
  EXPECT_EQ(fault_of(driven(12, 1.0)), warning);
  EXPECT_EQ(fault_of(driven(12, 1.01)), "end of a.log after 12 observations");
  EXPECT_EQ(fault_of(driven(9, 1.0)), "end of a.log after 9 observations") << "too few to judge";
}

TEST_F(CarmenFaults, ACutOffLogIsRefusedOrReadAsFarAsItGoes) {
  std::string text;
  std::mt19937 random(1);
  for (int i = 0; i < 3000; ++i)
    text += "FLASER 1 " + std::to_string(random() % 8000) + "e-3 0 0 0 0 0 0 " + std::to_string(i) + " host 1\n";
  const std::string packed = folder_.gzip(text);
  const std::string half = packed.substr(0, packed.size() / 2);
  EXPECT_THAT(fault_of(half, "a.log.gz"), HasSubstr(":1: the compressed log is cut off here"));
  config_.on_bad_line = log_common::BadLine::skip;
  EXPECT_THAT(fault_of(half, "a.log.gz"), HasSubstr("observations; 1 bad line skipped, the first: a.log.gz:"));
  EXPECT_GT(seen_, 100U);
  EXPECT_LT(seen_, 3000U);
}

TEST_F(CarmenFaults, ALineOfTenMegabytesIsRefusedOrSkipped) {
  std::string text = kGood + "FLASER 2000000";
  for (int i = 0; i < 2000000; ++i) text += " 1.25";
  text += "\n" + kGood;
  ASSERT_GT(text.size(), 10000000U);
  EXPECT_EQ(fault_of(text), "a.log:2:1: the line is longer than 1048576 characters");
  config_.on_bad_line = log_common::BadLine::skip;
  (void)fault_of(text);
  EXPECT_EQ(seen_, 2U);
}

TEST_F(CarmenFaults, ClocksThatJumpAreBridgedOrRefused) {
  const std::string text =
      "FLASER 0 0 0 0 0 0 0 5 host 5\nFLASER 0 0 0 0 0 0 0 6 host 6\nFLASER 0 0 0 0 0 0 0 1 host 1\n";
  EXPECT_EQ(fault_of(text), "end of a.log after 3 observations; 1 clock jump bridged, the first at line 3");
  config_.on_clock_jump = log_common::ClockJump::refuse;
  EXPECT_EQ(fault_of(text), "a.log:3:1: the clock jumps from 6 s to 1 s");
}

TEST_F(CarmenFaults, SonarsBeforeAnyPoseAreTakenWhereTheFirstOneIs) {
  EXPECT_EQ(fault_of("SONAR 0.5 1 1 0 0 0 1 host 1\n"), "end of a.log after 1 observations");
}

TEST_F(CarmenFaults, SettingsThatFitNoLogAreRefused) {
  config_.lines = {"FLASSER"};
  EXPECT_EQ(fault_of(kGood), "a.log: lines: there are no ranges in \"FLASSER\" (did you mean \"FLASER\"?)");
  config_.lines.clear();
  config_.sonar.min_m = 5.0;
  EXPECT_EQ(fault_of(kGood), "a.log: sonar: min_m must be less than max_m");
}

TEST_F(CarmenFaults, AnotherKindOfFileHoldsNoObservation) {
  EXPECT_EQ(fault_of(""), "a.log: the log holds no observation");
  EXPECT_EQ(fault_of("mission: office\nseed: 7\n"), "a.log: the log holds no observation; 2 lines of unknown kinds");
}

TEST_F(CarmenFaults, BrokenRecordingsAreRefused) {
  const std::string sensor = "PARAM cairn_sensor_0 0,0.1,0,0,0.26,0.1,5 0 cairn 0\n";
  EXPECT_EQ(fault_of("PARAM cairn_sensor_0 0,0.1,0,0,0.26,5,5 0 cairn 0\n"),
            "a.log:1:22: not the values of a sensor: sensor,x,y,theta,half_beam,min,max");
  EXPECT_EQ(fault_of("PARAM cairn_sensor_0 0,0.1 0 cairn 0\n"),
            "a.log:1:22: expected 7 numbers with commas between them");
  EXPECT_EQ(fault_of(sensor + "PARAM cairn_observation 0,none,0-3 1 cairn 1\n"),
            "a.log:2:25: no PARAM cairn_sensor_1 so far");
  EXPECT_EQ(fault_of(sensor + "PARAM cairn_observation 0,north,0 1 cairn 1\n"),
            "a.log:2:25: the compass must be a number or \"none\", not \"north\"");
  EXPECT_EQ(fault_of(sensor + "PARAM cairn_observation 0,none,0 1 cairn 1\n"),
            "a.log:2:1: the recorded observation before has 0 of 1 ranges");
}

TEST_F(CarmenFaults, RandomlyBrokenLogsNeverCrash) {
  const std::string good =
      "PARAM robot_frontlaser_offset 0.1 h 0\nODOM 0 0 0 0 0 0 1 h 1\n" + kGood +
      "ROBOTLASER1 0 -1 2 1 20 0 0 2 1 1 2 9 9 0 0 0 0 0 0 0 0 0 0 0 7 h 1\nSONAR 0.5 1 1 0 0 0 8 h 1\n"
      "PARAM cairn_sensor_0 0,0.1,0,0,0.26,0.1,5 0 c 0\nPARAM cairn_observation 0,0.5,0 9 c 9\nSONAR 0.5 1 1 0 0 0 9 c "
      "9\n";
  config_.on_bad_line = log_common::BadLine::skip;
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::string text = good;
    for (int i = 0; i < 4; ++i) text[random() % text.size()] = " 0123456789.-e,\nnaF#"[random() % 20];
    (void)fault_of(text);
  }
}

}  // namespace
}  // namespace cairn::carmen_log
