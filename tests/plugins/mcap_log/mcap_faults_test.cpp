#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/mcap_log/mcap_log.hpp"
#include "tests/plugins/mcap_log/bags.hpp"

namespace cairn::mcap_log {
namespace {

using bags::BagWriter;
using bags::laser_bag;
using bags::played;
using testing::HasSubstr;
using testing::StartsWith;

TEST(McapFaults, TopicsThatMustBeChosenAreNamed) {
  const log_files::LogFolder folder;
  BagWriter bag;
  bag.tf("/tf_static", 0.0, "base_link", "laser", {});
  bag.odom(1.0, {});
  bag.odom(1.0, {}, "/odom_filtered");
  bag.scan(1.0, {1.0, 1.0, 1.0}, "/front");
  bag.scan(1.0, {2.0, 2.0, 2.0}, "/rear");
  const std::string bytes = bag.closed();
  EXPECT_THAT(
      played(folder, bytes).reason,
      StartsWith("a.mcap: ranges of several kinds or lasers; choose by `ranges` among /front, /rear. Its topics: "
                 "/front (sensor_msgs/msg/LaserScan), /odom (nav_msgs/msg/Odometry), "));
  Config config;
  config.ranges = {"/rear"};
  EXPECT_THAT(played(folder, bytes, config).reason,
              HasSubstr("several topics of odometry; choose by `odometry` among /odom, /odom_filtered"));
  config.odometry = "/odom";
  EXPECT_EQ(played(folder, bytes, config).seen.at(0).ranges[0].range_m, 2.0);
  config.ranges = {"/rear", "/front"};
  EXPECT_EQ(played(folder, bytes, config).seen.size(), 2U);
  config.ranges = {"/raer"};
  EXPECT_THAT(played(folder, bytes, config).reason,
              HasSubstr("ranges: the log has no topic \"/raer\" (did you mean \"/rear\"?)"));
  config.ranges = {"/odom"};
  EXPECT_THAT(played(folder, bytes, config).reason,
              HasSubstr("\"/odom\" is of nav_msgs/msg/Odometry, not of sensor_msgs/msg/Range or LaserScan"));
}

TEST(McapFaults, AMissingOdometryIsAnErrorThatSaysWhatToDo) {
  const log_files::LogFolder folder;
  BagWriter bag;
  bag.scan(1.0, {1.0, 1.0, 1.0});
  EXPECT_THAT(played(folder, bag.closed()).reason, HasSubstr("or `odometry: none`"));
}

TEST(McapFaults, ASensorWhosePlaceIsNotKnownIsAnErrorThatNamesTheFrames) {
  const log_files::LogFolder folder;
  BagWriter bag;
  bag.tf("/tf_static", 0.0, "base_link", "camera", {});
  bag.odom(1.0, {});
  bag.scan(1.0, {1.0, 1.0, 1.0});
  EXPECT_THAT(played(folder, bag.closed()).reason,
              AllOf(HasSubstr("no transform leads from the robot's frame \"base_link\" to \"laser\""),
                    HasSubstr("Frames of the log: base_link, camera")));
}

TEST(McapFaults, AFileThatIsCutOffIsReadUpToItsLastWholeChunk) {
  const log_files::LogFolder folder;
  exchange::McapOptions options;
  options.chunk_bytes = 3000;
  const std::string bytes = laser_bag(options);
  std::size_t most = 0;
  std::size_t all = played(folder, bytes).seen.size();
  for (std::size_t size = 200; size < bytes.size(); size += 97) {
    const auto cut = played(folder, bytes.substr(0, size));
    EXPECT_GE(cut.seen.size(), most);
    most = std::max(most, cut.seen.size());
    if (cut.seen.empty()) continue;
    EXPECT_THAT(cut.reason, HasSubstr("the file ends early"));
  }
  EXPECT_GT(most, all / 2);
  EXPECT_EQ(played(folder, "no MCAP").reason, "a.mcap: this is no MCAP file: it does not begin as one");
}

TEST(McapFaults, DamageIsRefusedAtItsByteOrSkippedAndCounted) {
  const log_files::LogFolder folder;
  exchange::McapOptions options;
  options.chunk_bytes = 3000;
  options.compression = exchange::McapCompression::none;
  std::string bytes = laser_bag(options);
  const std::size_t third = bytes.find("laser", bytes.size() / 2);
  bytes[third] = 'L';
  EXPECT_THAT(played(folder, bytes).reason, StartsWith("a.mcap: byte "));
  EXPECT_THAT(played(folder, bytes).reason, HasSubstr("the checksum of a chunk is wrong"));
  Config config;
  config.on_bad_line = log_common::BadLine::skip;
  const auto skipped = played(folder, bytes, config);
  EXPECT_GT(skipped.seen.size(), 10U);
  EXPECT_LT(skipped.seen.size(), 21U);
  EXPECT_THAT(skipped.reason, HasSubstr("2 bad records skipped, the first: a.mcap: byte "));
}

TEST(McapFaults, AMessageThatIsNoneIsABadRecord) {
  const log_files::LogFolder folder;
  const auto reason = [&](const std::string& type, const std::string& message) {
    BagWriter bag;
    bag.tf("/tf_static", 0.0, "base_link", "laser", {});
    bag.odom(1.0, {});
    bag.write("/bad", type, 1.0, message);
    return played(folder, bag.closed()).reason;
  };
  const std::string kRange = "sensor_msgs/msg/Range";
  EXPECT_THAT(reason(kRange, "abc"), HasSubstr("the message is not in plain CDR"));
  const auto range = [](double half_beam_rad, double min_m, double max_m) {
    return bags::written::range({1, "laser"}, {half_beam_rad, min_m, max_m, 1.0});
  };
  EXPECT_THAT(reason(kRange, range(0.2, 1.0, 4.0).substr(0, 30)), HasSubstr("the message ends early"));
  for (const std::string& message : {range(0.2, 4.0, 1.0), range(2.0, 0.0, 1.0), range(0.2, std::nan(""), 1.0),
                                     range(0.2, 0.0, std::numeric_limits<double>::infinity())})
    EXPECT_THAT(reason(kRange, message), HasSubstr("are those of no sensor"));
  exchange::foxglove::Scan scan;
  EXPECT_THAT(reason("sensor_msgs/msg/LaserScan", bags::written::laser_scan({1, "laser"}, scan, 0.0, 1.0)),
              HasSubstr("the angles are those of no laser"));
  EXPECT_EQ(reason(kRange, range(0.2, 0.0, 4.0)), "end of a.mcap after 1 observations");
}

TEST(McapFaults, OtherEncodingsAreNamed) {
  const log_files::LogFolder folder;
  BagWriter bag;
  bag.write("/scan", "sensor_msgs/LaserScan", 1.0, "abc", "ros1");
  EXPECT_EQ(played(folder, bag.closed()).reason,
            "a.mcap: the log has no topic of ranges. Its topics: /scan (sensor_msgs/LaserScan in ros1)");
}

}  // namespace
}  // namespace cairn::mcap_log
