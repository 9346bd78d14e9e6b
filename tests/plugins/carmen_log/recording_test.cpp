// What RunRecording writes, carmen_log gives back to the last bit.
#include "framework/reporting/recordings/recording.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <random>

#include "maps/base/source_text.hpp"
#include "plugins/carmen_log/carmen_log.hpp"
#include "tests/plugins/log_files.hpp"

namespace cairn::carmen_log {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Recorded : Observation {
  std::optional<Pose2> true_T_map_robot{};
};

void record(const std::filesystem::path& file, const Pose2& T_map_start, const std::vector<Recorded>& observations) {
  const OccupancyGrid grid(0.05, 4.0);
  const LandmarkGraph graph;
  const RobotModel robot;
  RunRecording recording(file, T_map_start);
  for (const Recorded& observation : observations) {
    const WorldView world{grid, graph, robot, {}, observation.stamp_s, &observation};
    MissionView view{world};
    if (observation.true_T_map_robot) view.truth = GroundTruth{*observation.true_T_map_robot};
    recording.on(TickDone{}, view);
    recording.on(Message{"not written"}, view);
  }
  recording.close();
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}
bool same_bits(const Pose2& a, const Pose2& b) {
  return same_bits(a.x_m, b.x_m) && same_bits(a.y_m, b.y_m) && same_bits(a.theta_rad, b.theta_rad);
}
bool same_bits(const RangeReading& a, const RangeReading& b) {
  return same_bits(a.T_robot_sensor, b.T_robot_sensor) && same_bits(a.half_beam_rad, b.half_beam_rad) &&
         same_bits(a.min_m, b.min_m) && same_bits(a.max_m, b.max_m) && same_bits(a.range_m, b.range_m) &&
         a.sensor == b.sensor;
}

void expect_same(const std::vector<Recorded>& actual, const std::vector<Recorded>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    const Recorded& a = actual[i];
    const Recorded& e = expected[i];
    EXPECT_TRUE(same_bits(a.stamp_s, e.stamp_s)) << i;
    EXPECT_TRUE(same_bits(a.T_odom_robot, e.T_odom_robot)) << i;
    EXPECT_EQ(a.compass_rad.has_value(), e.compass_rad.has_value());
    EXPECT_TRUE(same_bits(a.compass_rad.value_or(0.0), e.compass_rad.value_or(0.0))) << i;
    EXPECT_EQ(a.bumped, e.bumped) << i;
    EXPECT_EQ(a.true_T_map_robot, e.true_T_map_robot) << i;
    ASSERT_EQ(a.ranges.size(), e.ranges.size()) << i;
    for (std::size_t k = 0; k < a.ranges.size(); ++k) EXPECT_TRUE(same_bits(a.ranges[k], e.ranges[k])) << i << " " << k;
  }
}

std::vector<Recorded> played(const std::filesystem::path& file, std::optional<Pose2>& start) {
  Config config;
  config.file = file;
  config.compass_from_pose = true;  // must not touch a recorded compass
  log_common::ScanPlayer player(read_carmen_log(config));
  start = player.start();
  std::vector<Recorded> seen;
  for (SensorStep step = player.next({}); step.state == SensorState::observation; step = player.next({})) {
    const std::optional<GroundTruth> truth = player.truth()->last_truth();
    seen.push_back({std::move(step.observation), truth ? std::optional(truth->T_map_robot) : std::nullopt});
  }
  return seen;
}

// Numbers with all their bits; some sensors alike but for one value, one ray among the cones.
std::vector<Recorded> random_observations() {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> anything(-3.14, 3.14);
  std::vector<RangeReading> sensors(6);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    sensors[i].T_robot_sensor = {anything(random), anything(random), anything(random)};
    sensors[i].half_beam_rad = i == 4 ? 0.0 : radians(15.0);
    sensors[i].min_m = 0.1;
    sensors[i].max_m = 5.0;
    sensors[i].sensor = static_cast<int>(i);
  }
  sensors[3] = sensors[2];
  sensors[3].max_m = 6.0;
  sensors[5].T_robot_sensor = sensors[0].T_robot_sensor;
  std::vector<Recorded> observations;
  for (int i = 0; i < 200; ++i) {
    Recorded seen;
    seen.stamp_s = 0.04 * i;
    seen.T_odom_robot = {anything(random), anything(random) * 1e-9, anything(random)};
    if (random() % 2 == 0) seen.compass_rad = anything(random);
    seen.bumped = random() % 5 == 0;
    seen.true_T_map_robot = Pose2{anything(random), 1e-300, anything(random)};
    for (std::size_t k = random() % 7; k > 0; --k) {
      seen.ranges.push_back(sensors[random() % sensors.size()]);
      const double odd[] = {kInfinity, -kInfinity, std::nan(""), 0.1, seen.ranges.back().max_m};
      const std::size_t which = random() % 10;
      seen.ranges.back().range_m = which < std::size(odd) ? odd[which] : 0.1 + std::abs(anything(random));
    }
    observations.push_back(seen);
  }
  return observations;
}

TEST(Recording, GivesEveryObservationBackToTheLastBit) {
  const log_files::LogFolder folder;
  const auto file = folder.write("a.log", "");
  const std::vector<Recorded> observations = random_observations();
  const Pose2 begun{0.1 + 0.2, -1.0 / 3.0, 2.9};
  record(file, begun, observations);
  std::optional<Pose2> start;
  const auto seen = played(file, start);
  expect_same(seen, observations);
  EXPECT_EQ(start, begun);
}

TEST(Recording, PackedByGzipItGivesTheSame) {
  const log_files::LogFolder folder;
  const auto plain = folder.write("a.log", "");
  const auto packed = folder.write("a.log.gz", "");
  const std::vector<Recorded> observations = random_observations();
  record(plain, {}, observations);
  record(packed, {}, observations);
  EXPECT_LT(std::filesystem::file_size(packed), std::filesystem::file_size(plain) / 2);
  EXPECT_EQ(exchange::text_of_file(packed), exchange::text_of_file(plain));
  std::optional<Pose2> start;
  expect_same(played(packed, start), observations);
}

// As a program that is killed leaves it.
TEST(Recording, PackedByGzipItLacksFiveSecondsAtMostWhenItWasNotClosed) {
  const log_files::LogFolder folder;
  const auto file = folder.write("a.log.gz", "");
  RunRecording recording(file, {});
  const OccupancyGrid grid(0.05, 4.0);
  const LandmarkGraph graph;
  const RobotModel robot;
  Recorded seen;
  for (int i = 0; i < 200; ++i) {
    seen.stamp_s = 0.1 * i;
    seen.ranges = {{{0.1, 0.2, 0.25}, 0.25, 0.1, 5.0, 1.0 + 0.01 * i, 0}};
    const WorldView world{grid, graph, robot, {}, seen.stamp_s, &seen};
    recording.on(TickDone{}, {world});
  }
  std::optional<Pose2> start;
  const auto left = played(file, start);
  ASSERT_GE(left.size(), 150U);
  EXPECT_EQ(left[149].ranges[0].range_m, 1.0 + 0.01 * 149);
}

TEST(Recording, ASensorWithoutANearestDistanceKeepsItsTooNear) {
  const log_files::LogFolder folder;
  Recorded seen;
  seen.ranges.push_back({{}, 0.2, 0.0, 5.0, -kInfinity, 0});
  seen.ranges.push_back({{}, 0.2, 0.0, 5.0, 0.0, 0});
  const auto file = folder.write("a.log", "");
  record(file, {}, {seen});
  std::optional<Pose2> start;
  expect_same(played(file, start), {seen});
}

Recorded with_a_scan(double stamp_s, int beams) {
  Recorded seen;
  seen.stamp_s = stamp_s;
  seen.T_odom_robot = {1.0 / 3.0, -0.2, 0.5};
  seen.ranges = {{{0.1, 0.2, 0.25}, 0.25, 0.1, 5.0, 1.5, 0}};
  LaserModel laser;
  laser.beams = beams;
  laser.T_robot_laser = {0.1, 0.02, 0.3};
  for (int i = 0; i < beams; ++i)
    seen.ranges.push_back(
        {laser.T_robot_beam(i), 0.0, 0.05, 8.0, i == 1 ? kInfinity : 1.0 + 0.1 * stamp_s + 0.01 / (i + 1), i + 1});
  return seen;
}

TEST(Recording, GivesScansOfLasersBackToTheLastBit) {
  const log_files::LogFolder folder;
  const auto file = folder.write("a.log", "");
  const std::vector<Recorded> observations{with_a_scan(1.0, 181), with_a_scan(1.1, 181), with_a_scan(1.2, 2)};
  record(file, {}, observations);
  std::optional<Pose2> start;
  expect_same(played(file, start), observations);
}

TEST(Recording, AScanIsALasersLineForReadersThatKnowNoCairnLines) {
  const log_files::LogFolder folder;
  const auto file = folder.write("a.log", "");
  Recorded seen;
  seen.stamp_s = 2.5;
  seen.T_odom_robot = {1.0, 2.0, 0.0};
  for (int i = 0; i < 3; ++i) seen.ranges.push_back({{0.25, 0.0, 0.5 * i - 0.5}, 0.0, 0.1, 5.0, 1.5 + i, i});
  record(file, {}, {seen});
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with("PARAM cairn_") && !line.starts_with("#")) lines.push_back(line);
  EXPECT_THAT(lines, testing::ElementsAre("ODOM 1 2 0 0 0 0 2.5 cairn 2.5",
                                          "ROBOTLASER1 0 -0.5 1 0.5 5 0 0 3 1.5 2.5 3.5 0 1.25 2 0 1 2 0 0 0 0 0 0 "
                                          "2.5 cairn 2.5"));
  std::ofstream(file) << lines[0] << "\n" << lines[1] << "\n";
  std::optional<Pose2> start;
  const auto read = played(file, start);
  ASSERT_EQ(read.size(), 1U);
  ASSERT_EQ(read[0].ranges.size(), 3U);
  EXPECT_NEAR(read[0].ranges[2].T_robot_sensor.theta_rad, 0.5, 1e-9);
  EXPECT_NEAR(read[0].ranges[2].T_robot_sensor.x_m, 0.25, 1e-9);
  EXPECT_EQ(read[0].ranges[2].range_m, 3.5);
}

TEST(Recording, IsACarmenLogForReadersThatKnowNoCairnLines) {
  const log_files::LogFolder folder;
  Recorded seen;
  seen.stamp_s = 2.5;
  seen.T_odom_robot = {1.0, 2.0, 0.5};
  seen.ranges = {{{0.1, 0.2, 0.25}, 0.25, 0.1, 5.0, 1.5, 0}, {{0.1, -0.2, -0.25}, 0.25, 0.1, 5.0, kInfinity, 1}};
  const auto file = folder.write("a.log", "");
  record(file, {}, {seen});
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with("PARAM cairn_") && !line.starts_with("#")) lines.push_back(line);
  EXPECT_THAT(lines, testing::ElementsAre("ODOM 1 2 0.5 0 0 0 2.5 cairn 2.5",
                                          "SONAR 0.5 2 1.5 6 0.1 0.2 0.25 0.1 -0.2 -0.25 2.5 cairn 2.5"));
}

TEST(Recording, AFileThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(RunRecording("/no/such/folder/a.log", {}), std::runtime_error);
}

}  // namespace
}  // namespace cairn::carmen_log
