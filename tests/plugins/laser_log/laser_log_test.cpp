#include "plugins/laser_log/laser_log.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plugins/carmen_log/carmen_log.hpp"
#include "plugins/json_log/json_log.hpp"
#include "plugins/player_log/player_log.hpp"
#include "tests/plugins/log_files.hpp"

namespace cairn::laser_log {
namespace {

const std::string kFlaser = "FLASER 3 1 2 81.9 5 6 0.5 1 0 0 7.5 host 0\n";

TEST(LaserLog, KnowsTheReaderByTheContentWhateverTheNameAndTheCompression) {
  const log_files::LogFolder folder;
  const auto reader = [&](const std::string& text) { return reader_of(folder.write("a.log", text), {}).name; };
  EXPECT_EQ(reader("\n  {\"map\": {}}"), "json_log");
  EXPECT_EQ(reader("## Player version 2.1\n## File version 0.3.0\n"), "player_log");
  EXPECT_EQ(reader("# message_name fields\n" + kFlaser), "carmen_log");
  EXPECT_EQ(reader("VERTEX2 0 0 0 0\nROBOTLASER1 0\n"), "carmen_log");
  EXPECT_EQ(reader(folder.gzip("{\"map\": {}}")), "json_log");
  EXPECT_EQ(reader("1.5 host 6665 position2d 00 001 001 0 0 0 0 0 0 0\r\n"), "player_log") << "a log without its head";
  EXPECT_EQ(reader("PARAM a b\nODOM 0 0 0 0 0 0 1 h 1\nLASER_READING 1 2 0 0 0 1\n"), "carmen_log");
  EXPECT_EQ(reader("\x89MCAP0\r\n"), "mcap_log");
  EXPECT_EQ(reader(folder.gzip("\x89MCAP0\r\n\x01")), "mcap_log");
  EXPECT_EQ(reader(""), "carmen_log") << "which says that there is no observation";
  EXPECT_EQ(reader("{\"map\": " + std::string(3'000'000, ' ')), "json_log") << "one long line";
}

TEST(LaserLog, ReadsTheRawOdometryOfACarmenLog) {
  const log_files::LogFolder folder;
  const PluginChoice choice = reader_of(folder.write("a.log", kFlaser), {});
  const ConfigValue* poses = choice.config.find("poses");
  ASSERT_NE(poses, nullptr);
  EXPECT_EQ(poses->scalar, "odometry");
}

TEST(LaserLog, RangesThatNoWallOfABuildingHasSayNothing) {
  const log_files::LogFolder folder;
  carmen_log::Config config;
  config.file = folder.write("a.log", kFlaser);
  LaserLog log(std::make_shared<log_common::ScanPlayer>(carmen_log::read_carmen_log(config)), 30.0);
  const SensorStep step = log.next({});
  ASSERT_EQ(step.state, SensorState::observation);
  EXPECT_EQ(step.observation.ranges[1].range_m, 2.0);
  EXPECT_TRUE(std::isnan(step.observation.ranges[2].range_m));
  EXPECT_EQ(step.observation.recorded_s, 7.5);
  EXPECT_EQ(log.next({}).state, SensorState::end_of_data);
}

TEST(LaserLog, AGreatestRangeThatComesOftenIsNoEcho) {
  const log_files::LogFolder folder;
  const auto longest_m = [&](const std::string& text) {
    carmen_log::Config config;
    config.file = folder.write("a.log", text);
    log_common::ScanPlayer log(carmen_log::read_carmen_log(config));
    return longest_echo_m(log, 30.0, {});
  };
  std::string text;
  for (int i = 0; i < 20; ++i) text += "FLASER 3 1 2 8.191 0 0 0 0 0 0 " + std::to_string(i) + " host 0\n";
  EXPECT_NEAR(longest_m(text), 0.995 * 8.191, 1e-9);
  EXPECT_EQ(longest_m(text + "FLASER 3 1 2 12.5 0 0 0 0 0 0 30 host 0\n"), 30.0) << "a wall that was seen once";
  EXPECT_EQ(longest_m(kFlaser), 30.0);
  std::string two_codes;
  std::string wall;
  for (int i = 0; i < 40; ++i) {
    const std::string rest = " 0 0 0 0 0 0 " + std::to_string(i) + " host 0\n";
    two_codes += "FLASER 4 1 2 20 81.91" + rest;
    wall += "FLASER 4 1 2 12.3" + std::to_string(i % 4) + " 12.0" + rest;
  }
  EXPECT_NEAR(longest_m(two_codes), 0.995 * 20.0, 1e-9) << "below a greater one that is none anyway";
  EXPECT_EQ(longest_m(wall), 30.0) << "ranges that lie close together are those of a wall";
}

// What robots of others write, each as three scans with the same echoes 2 and 3 m away.
struct Variant {
  std::string name;
  std::string text;
};

std::vector<Variant> variants() {
  const auto lines = [](const std::string& before, const std::string& behind, const std::string& stamp_behind = "",
                        const std::string& end = "\n") {
    std::string text;
    for (int i = 0; i < 3; ++i) text += before + behind + std::to_string(i + 1) + stamp_behind + end;
    return text;
  };
  const std::string fan = " 0 -1.5 1.5 1.5 30 0.1 0 2 2 3 ";
  const std::string flaser = lines("FLASER 2 2 3 ", "0 0 0 1 0 0 ", " h 1");
  return {{"flaser", flaser},
          {"crlf", lines("FLASER 2 2 3 ", "0 0 0 1 0 0 ", " h 1", "\r\n")},
          {"no newline at the end", flaser.substr(0, flaser.size() - 1)},
          {"a truncated last line", flaser + "FLASER 2 2"},
          {"old flaser", lines("FLASER 2 2 3 ", "0 0 0 1 0 0 ")},
          {"robotlaser, old", lines("ROBOTLASER1" + fan, "0 0 0 1 0 0 0 0 0 0 ", " h 1")},
          {"robotlaser", lines("ROBOTLASER1" + fan + "0 ", "0 0 0 1 0 0 0 0 0 0 0 ", " h 1")},
          {"robotlaser with remissions", lines("ROBOTLASER1" + fan + "2 7 8 ", "0 0 0 1 0 0 0 0 0 0 0 ", " h 1")},
          {"rawlaser", "ODOM 0 0 0 0 0 0 1 h 1\n" + lines("RAWLASER1" + fan, "0 ", " h 1")},
          {"gmapping", lines("LASER_READING 2 2 3 ", "0 0 0 ")},
          {"centimetres", lines("L 0 0 0 25 0 0 200 300 ", "")},
          {"player", lines("", "", " 0 1 laser 00 001 001 1 -1.5 +1.5 +1.5 +30 2 2 0 3 1")},
          {"json", R"({"map": {"1": {"range": [2, 3]}, "2": {"range": [2, 3]}, "3": {"range": [2, 3]}}})"},
          {"truncated json", R"({"map": {"1": {"range": [2, 3]}, "2": {"range": [2, 3]}, "3": {"range": [2, 3]}, "4)"}};
}

// The reader's own settings, as a mission would load them.
std::shared_ptr<Sensor> played(const PluginChoice& choice) {
  const auto log = [&]() -> log_common::ScanLog {
    if (choice.name == "json_log") return json_log::read_json_log(load_config<json_log::Config>(choice.config, "log"));
    if (choice.name == "player_log")
      return player_log::read_player_log(load_config<player_log::Config>(choice.config, "log"), RobotModel{});
    return carmen_log::read_carmen_log(load_config<carmen_log::Config>(choice.config, "log"));
  };
  return std::make_shared<log_common::ScanPlayer>(log());
}

TEST(LaserLog, EveryScanOfEveryKindOfLogIsReadPlainAndPacked) {
  const log_files::LogFolder folder;
  for (const Variant& variant : variants())
    for (const bool packed : {false, true}) {
      SCOPED_TRACE(variant.name + (packed ? ", gzip" : ""));
      const auto file = folder.write("a.log", packed ? folder.gzip(variant.text) : variant.text);
      LaserLog log(played(reader_of(file, {})), 30.0);
      for (int i = 0; i < 3; ++i) {
        const SensorStep step = log.next({});
        ASSERT_EQ(step.state, SensorState::observation);
        EXPECT_EQ(step.observation.recorded_s, i + 1.0);
        ASSERT_EQ(step.observation.ranges.size(), 2U);
        EXPECT_NEAR(step.observation.ranges[0].range_m, 2.0, 1e-12);
        EXPECT_NEAR(step.observation.ranges[1].range_m, 3.0, 1e-12);
      }
      EXPECT_EQ(log.next({}).state, SensorState::end_of_data);
    }
}

TEST(LaserLog, EveryWayToWriteNoEchoSaysNothing) {
  const log_files::LogFolder folder;
  for (const std::string code : {"0", "0.000", "nan", "NaN", "inf", "-1", "80", "81.91", "50", "1e30", "1.#QNAN"}) {
    SCOPED_TRACE(code);
    LaserLog log(played(reader_of(folder.write("a.log", "FLASER 2 " + code + " 3 0 0 0 0 0 0 1 h 1\n"), {})), 30.0);
    const SensorStep step = log.next({});
    ASSERT_EQ(step.state, SensorState::observation);
    EXPECT_TRUE(std::isnan(step.observation.ranges[0].range_m));
    EXPECT_EQ(step.observation.ranges[1].range_m, 3.0);
  }
}

TEST(LaserLog, OdomLinesServeWhereTheLaserLinesOdometryStandsStill) {
  const log_files::LogFolder folder;
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += "ODOM " + std::to_string(i) + " 0 0 0 0 0 " + std::to_string(i) + " h 0\nFLASER 1 2 0 0 0 0 0 0 " +
            std::to_string(i) + " h 0\n";
  const auto log = played(reader_of(folder.write("a.log", text), {}));
  (void)log->next({});
  EXPECT_NEAR(log->next({}).observation.T_odom_robot.x_m, 1.0, 1e-12);
}

TEST(LaserLog, AScanBecomesTheReadingsOfARingOfSonarsWhereThatIsAskedFor) {
  const log_files::LogFolder folder;
  std::string text = "FLASER 180";
  for (int i = 0; i < 180; ++i) text += i == 100 ? " 2" : i > 150 ? " 9" : " 4";
  Config config;
  config.sonars = 8;
  LaserLog log(played(reader_of(folder.write("a.log", text + " 0 0 0 0 0 0 1 h 1\n"), {})), 30.0, config);
  const SensorStep step = log.next({});
  ASSERT_EQ(step.state, SensorState::observation);
  ASSERT_EQ(step.observation.ranges.size(), 8U);
  EXPECT_NEAR(step.observation.ranges[0].T_robot_sensor.theta_rad, radians(-90.0 + 179.0 / 16.0), 1e-9);
  EXPECT_NEAR(step.observation.ranges[4].range_m, 2.0, 1e-9) << "the nearest echo in the cone";
  EXPECT_NEAR(step.observation.ranges[3].range_m, 4.0, 1e-9);
  EXPECT_TRUE(std::isinf(step.observation.ranges[7].range_m)) << "beyond the sonar's reach";
}

TEST(LaserLog, TheReasonAtTheEndNamesWornWheels) {
  const log_files::LogFolder folder;
  const std::string file = folder.write("a.log", kFlaser);
  const auto end_of = [&](const Config& config) {
    LaserLog log(played(reader_of(file, {})), 30.0, config);
    SensorStep step = log.next({});
    while (step.state == SensorState::observation) step = log.next({});
    return step.reason;
  };
  Config worn;
  worn.worsen = {0.03, radians(2.0), 4};
  EXPECT_EQ(end_of({}).find("odometry worsened"), std::string::npos);
  EXPECT_NE(end_of(worn).find("odometry worsened: 3 % longer, 2 deg per square root of a metre, seed 4"),
            std::string::npos);
}

TEST(LaserLog, AFileThatIsNotThereIsRefused) {
  EXPECT_THROW((void)reader_of("/nowhere/a.log", {}), ConfigError);
}

}  // namespace
}  // namespace cairn::laser_log
