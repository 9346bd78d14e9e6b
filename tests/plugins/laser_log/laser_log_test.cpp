#include "plugins/laser_log/laser_log.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plugins/carmen_log/carmen_log.hpp"
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
}

TEST(LaserLog, AFileThatIsNotThereIsRefused) {
  EXPECT_THROW((void)reader_of("/nowhere/a.log", {}), ConfigError);
}

}  // namespace
}  // namespace cairn::laser_log
