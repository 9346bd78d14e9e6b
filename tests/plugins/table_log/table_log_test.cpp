#include "plugins/table_log/table_log.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>

#include "framework/config/config_value.hpp"
#include "tests/plugins/log_files.hpp"

namespace cairn {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class TableLogTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ("table_log_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
    config_.time_column = 1;
    config_.first_range_column = 2;
    LogSonar right, left;
    right.angle_rad = radians(-90);
    left.angle_rad = radians(90);
    config_.sonars = {right, left};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::vector<Observation> play(const std::string& text) {
    config_.file = write("log.txt", text);
    TableLog log(config_, robot_);
    EXPECT_EQ(log.truth(), nullptr) << "it never knows";
    std::vector<Observation> seen;
    while (true) {
      const SensorStep step = log.next({});
      if (step.state == SensorState::observation) {
        seen.push_back(step.observation);
        continue;
      }
      EXPECT_EQ(step.state, SensorState::end_of_data);
      EXPECT_EQ(log.next({}).state, SensorState::end_of_data) << "the end stays the end";
      reason_ = step.reason;
      return seen;
    }
  }
  // The error of a log, with the folder cut off.
  std::string error_of(const std::string& text) {
    try {
      play(text);
    } catch (const ConfigError& error) {
      std::string what = error.what();
      const std::string folder = folder_.string() + "/";
      for (std::size_t at; (at = what.find(folder)) != std::string::npos;) what.erase(at, folder.size());
      return what;
    }
    return "no error";
  }
  void give_poses(const std::string& text) {
    TableConfig poses;
    poses.file = write("poses.txt", text);
    poses.time_column = 1;
    poses.x_column = 2;
    poses.y_column = 3;
    poses.heading_column = 4;
    config_.poses = poses;
  }

  std::filesystem::path folder_;
  TableLogConfig config_;
  RobotModel robot_;
  std::string reason_;
};

TEST_F(TableLogTest, ReadsTimesAndRangesInTheirUnits) {
  config_.time_unit = TimeUnit::milliseconds;
  config_.range_unit = LengthUnit::millimetres;
  const auto seen = play("1500 1000 2500\n1540 990 4999\n");
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_DOUBLE_EQ(seen[0].stamp_s, 1.5);
  EXPECT_DOUBLE_EQ(seen[1].stamp_s, 1.54);
  EXPECT_DOUBLE_EQ(seen[0].ranges[0].range_m, 1.0);
  EXPECT_DOUBLE_EQ(seen[1].ranges[1].range_m, 4.999);
  EXPECT_DOUBLE_EQ(seen[0].ranges[0].T_robot_sensor.theta_rad, radians(-90));
  EXPECT_EQ(seen[0].ranges[1].sensor, 1);
  EXPECT_FALSE(seen[0].compass_rad.has_value());
  EXPECT_EQ(reason_, "end of log.txt after 2 observations");
}

TEST_F(TableLogTest, ReadsAGzipTableAndRefusesACutOffOne) {
  const std::string packed = log_files::LogFolder().gzip("1 1.5 2.5\n");
  EXPECT_DOUBLE_EQ(play(packed)[0].ranges[1].range_m, 2.5);
  const std::string cut_off = packed.substr(0, packed.size() - 4);
  EXPECT_EQ(error_of(cut_off), "log.txt:2:1: the compressed log is cut off here");
  config_.on_bad_line = BadLine::skip;
  EXPECT_EQ(play(cut_off).size(), 1U);
  EXPECT_THAT(reason_, HasSubstr("1 bad line skipped, the first: log.txt:2:1: the compressed log is cut off here"));
}

TEST_F(TableLogTest, HasARuleForEveryOddRange) {
  config_.no_echo = {9999, 0};
  const auto seen = play("1 9999 0\n2 0.05 5.5\n3 nan -1\n4 inf -inf\n");
  EXPECT_EQ(seen[0].ranges[0].range_m, kInfinity) << "no echo";
  EXPECT_EQ(seen[0].ranges[1].range_m, kInfinity) << "another mark of no echo";
  EXPECT_EQ(seen[1].ranges[0].range_m, -kInfinity) << "nearer than min_m";
  EXPECT_EQ(seen[1].ranges[1].range_m, kInfinity) << "beyond max_m";
  EXPECT_TRUE(std::isnan(seen[2].ranges[0].range_m));
  EXPECT_TRUE(std::isnan(seen[2].ranges[1].range_m)) << "negative";
  EXPECT_EQ(seen[3].ranges[0].range_m, kInfinity);
  EXPECT_EQ(seen[3].ranges[1].range_m, -kInfinity);
}

TEST_F(TableLogTest, OdometryBeginsAtIdentityAndTheStartIsTheFirstPose) {
  config_.x_column = 4;
  config_.y_column = 5;
  config_.heading_column = 6;
  config_.length_unit = LengthUnit::centimetres;
  config_.compass_from_pose = true;
  config_.file = write("log.txt", "1 1 1 100 200 90\n2 1 1 100 250 180\n");
  TableLog log(config_, robot_);
  ASSERT_TRUE(log.start().has_value());
  EXPECT_EQ(log.drive(), nullptr);
  EXPECT_NEAR(log.start()->x_m, 1.0, 1e-12);
  EXPECT_NEAR(log.start()->y_m, 2.0, 1e-12);
  EXPECT_NEAR(log.start()->theta_rad, radians(90), 1e-12);
  EXPECT_EQ(log.next({}).observation.T_odom_robot, Pose2{});
  const Observation second = log.next({}).observation;
  EXPECT_NEAR(second.T_odom_robot.x_m, 0.5, 1e-12) << "ahead of where it began";
  EXPECT_NEAR(second.T_odom_robot.y_m, 0.0, 1e-12);
  EXPECT_NEAR(second.T_odom_robot.theta_rad, radians(90), 1e-12);
  EXPECT_NEAR(*second.compass_rad, radians(180), 1e-12);
}

TEST_F(TableLogTest, ReadsWithoutTimesAndPoses) {
  config_.time_column = 0;
  config_.first_range_column = 1;
  config_.separator = Separator::comma;
  config_.skip_lines = 1;
  config_.period_s = 0.5;
  const auto seen = play("right,left,class\r\n1.0, 2.0,Move\r\n\r\n1.5,2.5,Turn");
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_DOUBLE_EQ(seen[1].stamp_s, 0.5);
  EXPECT_DOUBLE_EQ(seen[0].ranges[1].range_m, 2.0);
  EXPECT_DOUBLE_EQ(seen[1].ranges[1].range_m, 2.5);
  TableLog log(config_, robot_);
  EXPECT_FALSE(log.start().has_value());
}

TEST_F(TableLogTest, TakesTheRobotsSonarsWhenTheLogNamesNone) {
  config_.sonars.clear();
  robot_.sonars.resize(3);
  robot_.sonars[2].max_m = 2.0;
  const auto seen = play("1 1 1 2.5\n");
  ASSERT_EQ(seen[0].ranges.size(), 3U);
  EXPECT_EQ(seen[0].ranges[2].range_m, kInfinity);
}

TEST_F(TableLogTest, PassesOverCommentsBlankLinesAndAByteOrderMark) {
  EXPECT_EQ(play("\xEF\xBB\xBF# t r l\n\n  # more\n1 1 1\n   \n\t2\t+1.5e0   1 \n").size(), 2U);
  config_.comment = "//";
  EXPECT_EQ(play("// t r l\n1 1 1\n").size(), 1U);
}

TEST_F(TableLogTest, JoinsPosesOfTheSameTime) {
  give_poses("1 0 0 0\n2 1 0 0\n3 2 0 90\n");
  const auto seen = play("1 1 1\n3 1 1\n");
  EXPECT_NEAR(seen[1].T_odom_robot.x_m, 2.0, 1e-12);
  EXPECT_EQ(error_of("1 1 1\n2.5 1 1\n"),
            "log.txt:2:1: no pose at 2.5 s in the table of poses (`join: not_later` takes the one before)");
}

TEST_F(TableLogTest, JoinsTheLastPoseNotLaterWhenAsked) {
  give_poses("1 0 0 0\n2 1 0 0\n3 2 0 90\n");
  config_.join = PoseJoin::not_later;
  const auto seen = play("1 1 1\n2.9 1 1\n9 1 1\n");
  EXPECT_NEAR(seen[1].T_odom_robot.x_m, 1.0, 1e-12);
  EXPECT_NEAR(seen[2].T_odom_robot.x_m, 2.0, 1e-12);
  EXPECT_EQ(error_of("0.5 1 1\n"), "log.txt:1:1: no pose as early as 0.5 s in the table of poses");
}

TEST_F(TableLogTest, RefusesBadLinesWithTheirPlace) {
  EXPECT_EQ(error_of("1 1 1\n2 1\n"), "log.txt:2:4: the line has 2 columns, but column 3 is to be the range 2");
  EXPECT_EQ(error_of("1 1 1\n2   far 1\n"), "log.txt:2:5: the range 1 (column 2) must be a number, not \"far\"");
  EXPECT_EQ(error_of("1 1 1m\n"), "log.txt:1:5: the range 2 (column 3) must be a number, not \"1m\"");
  EXPECT_EQ(error_of("# head\nnan 1 1\n"), "log.txt:2:1: the time (column 1) must be finite, not \"nan\"");
  EXPECT_EQ(error_of("2 1 1\n2 1 1\n1.5 1 1\n"), "log.txt:3:1: time goes backwards, from 2 s to 1.5 s");
  config_.separator = Separator::comma;
  EXPECT_EQ(error_of("1,,1\n"), "log.txt:1:3: the range 1 (column 2) must be a number, not \"\"");
}

TEST_F(TableLogTest, RefusesBadPoses) {
  give_poses("1 0 0 0\n2 0 nan 0\n");
  EXPECT_EQ(error_of("1 1 1\n"), "poses.txt:2:5: the y (column 3) must be finite, not \"nan\"");
  give_poses("2 0 0 0\n1 0 0 0\n");
  EXPECT_EQ(error_of("1 1 1\n"), "poses.txt:2:1: time goes backwards, from 2 s to 1 s");
  config_.poses->heading_column = 7;
  EXPECT_THAT(error_of("1 1 1\n"), HasSubstr("the line has 4 columns, but column 7 is to be the heading"));
}

TEST_F(TableLogTest, SkipsAndCountsBadLinesWhenAsked) {
  config_.on_bad_line = BadLine::skip;
  const auto seen = play("1 1 1\n2 1\n5 1 1\n3 1 1\n6 x 1\n7 1 1\n");
  ASSERT_EQ(seen.size(), 3U);
  EXPECT_DOUBLE_EQ(seen[2].stamp_s, 7.0);
  EXPECT_THAT(reason_, HasSubstr("after 3 observations; 3 bad lines skipped, the first: "));
  EXPECT_THAT(reason_, HasSubstr("log.txt:2:4"));
  EXPECT_THAT(error_of("x\ny\n"), StartsWith("log.txt: the log holds no observation; first bad line: log.txt:1:1"));
}

TEST_F(TableLogTest, RefusesAMissingFileAFolderAndAnEmptyLog) {
  EXPECT_EQ(error_of(""), "log.txt: the log holds no observation");
  EXPECT_EQ(error_of("# only words\n"), "log.txt: the log holds no observation");
  config_.file = folder_ / "nowhere.txt";
  EXPECT_THROW(TableLog(config_, robot_), ConfigError);
  config_.file = folder_;
  EXPECT_THROW(TableLog(config_, robot_), ConfigError);
}

TEST_F(TableLogTest, RefusesColumnsThatDoNotFit) {
  config_.range_columns = {2, 3, 4};
  EXPECT_THAT(error_of("1 1 1\n"), HasSubstr("3 range columns (range_columns or first_range_column) for 2 sonars"));
  config_.range_columns = {2, 2.5};
  EXPECT_THAT(error_of("1 1 1\n"), HasSubstr("whole numbers"));
  config_.range_columns.clear();
  config_.x_column = 2;
  EXPECT_THAT(error_of("1 1 1\n"), HasSubstr("a pose needs both x_column and y_column"));
  config_.x_column = 0;
  config_.compass_from_pose = true;
  EXPECT_THAT(error_of("1 1 1\n"), HasSubstr("compass_from_pose needs heading_column"));
  config_.compass_from_pose = false;
  give_poses("1 0 0 0\n");
  config_.poses->time_column = 0;
  EXPECT_THAT(error_of("1 1 1\n"), HasSubstr("joining poses by time needs time_column"));
}

TEST_F(TableLogTest, LoadsItsSettingsFromAMissionFile) {
  const ConfigValue value = parse_config_text(
      "{file: a/log.csv, separator: comma, skip_lines: 1, time_column: 1, time_unit: ms, range_columns: [3, 2],\n"
      " range_unit: mm, no_echo: [5110], on_bad_line: skip, join: not_later,\n"
      " poses: {file: /b/p.txt, time_column: 1, x_column: 2, y_column: 3, angle_unit: decideg},\n"
      " sonars: [{angle_deg: -90}, {x_m: 0.1, angle_deg: 90, half_beam_deg: 10, max_m: 5.1}]}",
      "/home/missions/m.yaml");
  const auto config = load_config<TableLogConfig>(value, "plugin table_log");
  EXPECT_EQ(config.file, "/home/missions/a/log.csv");
  EXPECT_EQ(config.separator, Separator::comma);
  EXPECT_EQ(config.time_unit, TimeUnit::milliseconds);
  EXPECT_EQ(config.range_unit, LengthUnit::millimetres);
  EXPECT_EQ(config.range_columns, (std::vector<double>{3, 2}));
  EXPECT_EQ(config.poses.value().file, "/b/p.txt");
  EXPECT_EQ(config.poses.value().angle_unit, AngleUnit::decidegrees);
  EXPECT_DOUBLE_EQ(config.sonars.at(1).half_beam_rad, radians(10));
  EXPECT_THROW((void)load_config<TableLogConfig>(parse_config_text("{time_column: 1}", "m.yaml"), "plugin table_log"),
               ConfigError)
      << "file is required";
  EXPECT_THROW((void)load_config<TableLogConfig>(parse_config_text("{file: x, time_colum: 1}", "m.yaml"), "plugin"),
               ConfigError);
}

TEST_F(TableLogTest, SurvivesAnyBytes) {
  std::mt19937_64 random(5);
  const std::string alphabet = std::string("0123456789.-+einfa \t,;#\n\r\xff") + '\0';
  for (int round = 0; round < 120; ++round) {
    std::string text;
    for (int i = 0; i < 200; ++i) text += alphabet[random() % alphabet.size()];
    config_.separator = static_cast<Separator>(round % 4);
    config_.on_bad_line = round % 2 == 0 ? BadLine::skip : BadLine::refuse;
    try {
      for (const Observation& seen : play(text)) ASSERT_TRUE(std::isfinite(seen.stamp_s));
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr("log.txt"));
    }
  }
}

std::filesystem::path data_folder() {
  const char* named = std::getenv("CAIRN_DATA");
  return named != nullptr ? std::filesystem::path(named) : std::filesystem::path(CAIRN_SOURCE_DIR) / "../shared/data";
}

TEST(TableLogOfCorridor8, PlaysBackTheWholeRunAsTheMissionDescribesIt) {
  if (!std::filesystem::exists(data_folder() / "sonar/corridor8/measurement.txt")) {
    GTEST_SKIP() << "needs sonar/corridor8 of the data folder (CAIRN_DATA)";
  }
  ::setenv("CAIRN_DATA", data_folder().c_str(), 1);
  const ConfigValue mission =
      read_config_file(std::filesystem::path(CAIRN_SOURCE_DIR) / "config/missions/corridor8.yaml");
  ConfigValue sensor = *mission.find("sensor");
  std::erase_if(sensor.entries, [](const ConfigValue::Entry& entry) { return entry.key == "plugin"; });
  TableLog log(load_config<TableLogConfig>(sensor, "plugin table_log"), RobotModel{});
  EXPECT_EQ(log.start(), Pose2{});
  int count = 0, readings = 0, silent = 0;
  Observation first, last;
  for (SensorStep step = log.next({}); step.state == SensorState::observation; step = log.next({})) {
    if (count++ == 0) first = step.observation;
    last = step.observation;
    for (const RangeReading& reading : last.ranges) {
      ++readings;
      silent += std::isinf(reading.range_m);
    }
  }
  EXPECT_EQ(count, 413);
  EXPECT_NEAR(last.stamp_s - first.stamp_s, 92.837, 1e-6);
  EXPECT_EQ(readings, 413 * 8);
  EXPECT_NEAR(silent / double(readings), 0.324, 0.001);
  EXPECT_NEAR(first.ranges[7].range_m, 1.19, 1e-12);
  EXPECT_NEAR(degrees(first.ranges[7].T_robot_sensor.theta_rad), 90.0, 1e-9);
  EXPECT_NEAR(last.T_odom_robot.x_m, 16.842, 1e-9);
  EXPECT_NEAR(last.T_odom_robot.y_m, -9.437, 1e-9);
  EXPECT_NEAR(degrees(*last.compass_rad), 263.1 - 360.0, 1e-9);
}

}  // namespace
}  // namespace cairn
