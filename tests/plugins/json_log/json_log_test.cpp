#include "plugins/json_log/json_log.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "tests/plugins/log_files.hpp"

namespace cairn::json_log {
namespace {

using ::testing::HasSubstr;

class JsonLog : public ::testing::Test {
 protected:
  std::vector<Observation> play(const std::string& text) {
    config_.file = folder_.write("a.json", text);
    return play();
  }
  std::vector<Observation> play() {
    log_common::ScanPlayer player(read_json_log(config_));
    start_ = player.start();
    return log_files::play(player, reason_);
  }
  std::string fault_of(const std::string& text) {
    try {
      play(text);
      return folder_.without_folder(reason_);
    } catch (const ConfigError& error) {
      return folder_.without_folder(error.what());
    }
  }

  log_files::LogFolder folder_;
  Config config_;
  std::optional<Pose2> start_;
  std::string reason_;
};

TEST_F(JsonLog, ReadsScansInOrderOfTheirTime) {
  const auto seen = play(R"({"map": {"10.5": {"range": [1, 2, 90], "x": 2, "y": 2, "theta": 0.5},
                                     "9.5": {"range": [1.5, 0.01, -1], "x": 1, "y": 2, "theta": 0.5}}})");
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_DOUBLE_EQ(seen[0].stamp_s, 9.5) << "by number, not as text";
  EXPECT_EQ(start_, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_DOUBLE_EQ(seen[0].ranges[0].range_m, 1.5);
  EXPECT_EQ(seen[0].ranges[1].range_m, -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(seen[0].ranges[2].range_m));
  EXPECT_EQ(seen[1].ranges[2].range_m, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(seen[1].ranges[2].T_robot_sensor.theta_rad, radians(90));
  EXPECT_NEAR(seen[1].T_odom_robot.x_m, std::cos(0.5), 1e-12);
}

TEST_F(JsonLog, TheRobotIsWhereTheLaserIsLessItsOffset) {
  config_.laser.x_m = 0.25;
  play(R"({"map": {"1": {"range": [1], "x": 2, "y": 2, "theta": 0}}})");
  EXPECT_EQ(start_, (Pose2{1.75, 2.0, 0.0}));
}

TEST_F(JsonLog, TextThatIsNoJsonIsRefusedAtItsPlace) {
  EXPECT_EQ(fault_of("{\"map\":\n  {\"1\": oops}}"), "a.json:2:9: no JSON from here on");
  EXPECT_EQ(fault_of(""), "a.json:1:1: no JSON from here on");
  EXPECT_EQ(fault_of("{\"map\": {\"1\": {\"range\": [1e999]}}}"), "a.json: a number in this JSON is too large");
  EXPECT_EQ(fault_of("[1, 2]"), "a.json: expected {\"map\": {STAMP: {range, x, y, theta}, ...}}");
  EXPECT_EQ(fault_of("{\"map\": 3}"), "a.json: expected {\"map\": {STAMP: {range, x, y, theta}, ...}}");
  EXPECT_EQ(fault_of("{\"map\": {}}"), "a.json: the log holds no observation");
  const std::string packed = folder_.gzip("{\"map\": {}}");
  EXPECT_EQ(fault_of(packed.substr(0, packed.size() - 3)), "a.json: the compressed log is cut off here");
  config_.on_bad_line = log_common::BadLine::skip;
  EXPECT_EQ(fault_of("{\"map\":\n  {\"1\": oops}}"), "a.json:2:9: no JSON from here on") << "no scan is whole";
}

TEST_F(JsonLog, BadScansAreRefusedByStampOrSkipped) {
  const std::string good = R"("2": {"range": [1], "x": 2, "y": 2, "theta": 0}}})";
  const auto with = [&](const std::string& scan) { return fault_of("{\"map\": {" + scan + ", " + good); };
  EXPECT_EQ(with(R"("1": {"x": 1, "y": 1, "theta": 0})"), "a.json: at stamp \"1\": no \"range\"");
  EXPECT_EQ(with(R"("1": 7)"), "a.json: at stamp \"1\": no \"range\"");
  EXPECT_EQ(with(R"("1": {"range": 3, "x": 1, "y": 1, "theta": 0})"),
            "a.json: at stamp \"1\": \"range\" must be a list");
  EXPECT_EQ(with(R"("1": {"range": ["far"], "x": 1, "y": 1, "theta": 0})"),
            "a.json: at stamp \"1\": a range must be a number");
  EXPECT_EQ(with(R"("1": {"range": [1], "x": 1e6, "y": 1, "theta": 0})"), "a.json: at stamp \"1\": x is beyond 100 km");
  EXPECT_EQ(with(R"("1": {"range": [1], "x": 1, "theta": 0})"), "a.json: at stamp \"1\": no \"y\"");
  EXPECT_EQ(with(R"("noon": {"range": [1], "x": 1, "y": 1, "theta": 0})"),
            "a.json: at stamp \"noon\": a stamp must be a number of seconds");
  config_.on_bad_line = log_common::BadLine::skip;
  EXPECT_THAT(with(R"("1": {"range": [1], "x": 1e6, "y": 1, "theta": 0})"),
              HasSubstr("end of a.json after 1 observations; 1 bad line skipped, the first: "));
}

TEST_F(JsonLog, NumbersThatJsonLacksAndScansWithoutPosesAreRead) {
  config_.file = folder_.write("a.json", R"({"map": {"1": {"range": [NaN, Infinity, null, 1e300, 2]},
                                            "2": {"range": [3], "x": 2, "y": 2, "theta": 0}}})");
  const auto seen = play();
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_TRUE(std::isnan(seen[0].ranges[0].range_m) && std::isnan(seen[0].ranges[2].range_m));
  EXPECT_TRUE(std::isinf(seen[0].ranges[1].range_m) && std::isinf(seen[0].ranges[3].range_m));
  EXPECT_EQ(seen[0].ranges[4].range_m, 2.0);
  EXPECT_EQ(seen[0].T_odom_robot, seen[1].T_odom_robot) << "before any pose the robot is where the first one says";
}

TEST_F(JsonLog, OfATextThatEndsEarlyTheWholeScansCountWhenBadLinesAreSkipped) {
  config_.on_bad_line = log_common::BadLine::skip;
  std::string text = "{\"map\": {";
  for (int i = 0; i < 500; ++i)
    text += "\"" + std::to_string(i) + ".5\": {\"range\": [1, " + std::to_string(1.0 / (i + 3)) +
            "], \"x\": " + std::to_string(i) + ", \"y\": 0, \"theta\": 0}, ";
  config_.file = folder_.write("a.json", text + "\"900\": {\"range\": [1, 2");
  EXPECT_EQ(play().size(), 500U);
  EXPECT_THAT(reason_, HasSubstr("1 bad line skipped"));
  const std::string packed = folder_.gzip(text + "}}");
  config_.file = folder_.write("b.json", packed.substr(0, packed.size() / 2));
  const std::size_t scans = play().size();
  EXPECT_GT(scans, 100U);
  EXPECT_LT(scans, 500U);
  EXPECT_THAT(reason_, HasSubstr("the compressed log is cut off here"));
}

TEST_F(JsonLog, DeepNestingIsRefusedNotACrash) {
  EXPECT_EQ(fault_of(std::string(1000000, '[')), "a.json:1:1000001: no JSON from here on");
}

TEST_F(JsonLog, ReadsTheIntelLogs) {
  const char* data = std::getenv("CAIRN_DATA");
  const auto folder = data != nullptr ? std::filesystem::path(data)
                                      : std::filesystem::path(CAIRN_SOURCE_DIR).parent_path() / "shared" / "data";
  if (!std::filesystem::exists(folder / "laser_carmen")) GTEST_SKIP() << "no data folder";
  config_.file = folder / "laser_carmen" / "intel_corrected_abs_time.json.gz";
  const auto seen = play();
  ASSERT_EQ(seen.size(), 910U);
  EXPECT_EQ(seen[0].ranges.size(), 180U);
  EXPECT_EQ(start_, (Pose2{0.600266, -0.0320327, -0.354665})) << "as the CARMEN log of the same drive has it";
  EXPECT_EQ(reason_, "end of intel_corrected_abs_time.json.gz after 910 observations");
}

}  // namespace
}  // namespace cairn::json_log
