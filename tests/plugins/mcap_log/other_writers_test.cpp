// Bags that were written by programs that are none of ours (make_bags.mjs): @mcap/core 2.2.2, its records unchunked,
// packed by lz4js and without index, and packed by the command zstd.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/mcap_log/mcap_log.hpp"
#include "tests/plugins/log_files.hpp"

namespace cairn::mcap_log {
namespace {

class OtherWriters : public testing::TestWithParam<const char*> {
 protected:
  static std::vector<Observation> observations(Config config, std::string& reason) {
    config.file = std::filesystem::path(CAIRN_SOURCE_DIR) / "tests/data" / GetParam();
    log_common::ScanPlayer player(read_mcap_log(config));
    return log_files::play(player, reason);
  }
};

TEST_P(OtherWriters, ALaserThatHangsUpsideDownIsRead) {
  Config config;
  config.ranges = {"/scan"};
  config.compass = "/imu";
  std::string reason;
  const std::vector<Observation> seen = observations(config, reason);
  EXPECT_EQ(reason, "end of " + std::string(GetParam()) + " after 21 observations");
  ASSERT_EQ(seen.size(), 21U);
  EXPECT_NEAR(seen[0].stamp_s, 100.05, 1e-6);
  EXPECT_NEAR(seen[10].T_odom_robot.x_m, 1.0, 1e-6);
  EXPECT_NEAR(seen[10].compass_rad.value(), 0.25, 1e-12);
  const std::vector<RangeReading>& rays = seen[10].ranges;
  ASSERT_EQ(rays.size(), 5U);
  EXPECT_NEAR(rays[0].T_robot_sensor.x_m, 0.2, 1e-12);
  EXPECT_NEAR(rays[0].T_robot_sensor.theta_rad, 1.0, 1e-6) << "its angles grow clockwise";
  EXPECT_NEAR(rays[4].T_robot_sensor.theta_rad, -1.0, 1e-6);
  EXPECT_EQ(rays[1].range_m, 1.5);
  EXPECT_NEAR(rays[2].range_m, 3.0, 1e-6);
  EXPECT_EQ(rays[3].range_m, std::numeric_limits<double>::infinity());
  EXPECT_EQ(rays[4].range_m, -std::numeric_limits<double>::infinity());
}

TEST_P(OtherWriters, ASonarATopicIsRead) {
  Config config;
  config.ranges = {"/sonar/left", "/sonar/right"};
  std::string reason;
  const std::vector<Observation> seen = observations(config, reason);
  ASSERT_EQ(seen.size(), 21U) << reason;
  ASSERT_EQ(seen[4].ranges.size(), 2U);
  EXPECT_EQ(seen[4].ranges[0].range_m, 1.25);
  EXPECT_NEAR(seen[4].ranges[0].T_robot_sensor.y_m, 0.15, 1e-12);
  EXPECT_EQ(seen[4].ranges[1].range_m, 0.75);
  EXPECT_TRUE(std::isinf(seen[5].ranges[1].range_m));
  EXPECT_EQ(seen[4].ranges[0].half_beam_rad, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Of, OtherWriters, testing::Values("bag.mcap", "bag_no_chunks.mcap", "bag_no_index.mcap"),
                         [](const auto& tested) {
                           const std::string name = tested.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace cairn::mcap_log
