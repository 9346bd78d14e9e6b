// Every log is read to its end, and what its observations promise is looked at.
#include <cmath>
#include <limits>

#include "plugins/carmen_log/carmen_log.hpp"
#include "plugins/common/logs/scan_log.hpp"
#include "plugins/json_log/json_log.hpp"
#include "plugins/laser_log/laser_log.hpp"
#include "plugins/lego_log/lego_log.hpp"
#include "plugins/mcap_log/mcap_log.hpp"
#include "plugins/player_log/player_log.hpp"
#include "plugins/table_log/table_log.hpp"
#include "tests/fuzz/scratch.hpp"

namespace cairn::fuzz {
namespace {

std::filesystem::path log_file(Input input) {
  return scratch_file("log", text_of(input));
}

void check(const RangeReading& reading) {
  const Pose2& at = reading.T_robot_sensor;
  promise(std::isfinite(at.x_m) && std::isfinite(at.y_m) && std::isfinite(at.theta_rad), "a sensor has a place");
  promise(reading.half_beam_rad >= 0.0 && reading.min_m >= 0.0 && reading.min_m < reading.max_m &&
              std::isfinite(reading.max_m) && reading.sensor >= 0,
          "a sensor has limits");
  promise(!std::isfinite(reading.range_m) || (reading.range_m >= reading.min_m && reading.range_m <= reading.max_m),
          "a range is within its limits");
}

void check(const Observation& seen, double last_s) {
  const Pose2& odom = seen.T_odom_robot;
  promise(seen.stamp_s >= last_s, "time does not go back");
  promise(std::isfinite(odom.x_m + odom.y_m + odom.theta_rad), "odometry is finite");
  for (const RangeReading& reading : seen.ranges) check(reading);
}

// What read() refuses by ConfigError is fine.
template <class Read>
void play(Read read) {
  try {
    log_common::ScanPlayer player(read());
    double last_s = -std::numeric_limits<double>::infinity();
    for (;;) {
      const SensorStep step = player.next({});
      if (step.state != SensorState::observation) {
        promise(!step.reason.empty(), "the end has a reason");
        return;
      }
      check(step.observation, last_s);
      last_s = step.observation.stamp_s;
    }
  } catch (const ConfigError&) {
  }
}

template <class Config>
Config with_rules(const std::filesystem::path& file) {
  Config config;
  config.file = file;
  config.on_bad_line = log_common::BadLine::skip;
  config.no_echo_means = log_common::NoEcho::nothing;
  return config;
}

}  // namespace

void read_carmen_log(Input input) {
  carmen_log::Config config;
  config.file = log_file(input);
  config.on_bad_line = log_common::BadLine::skip;
  play([&] { return carmen_log::read_carmen_log(config); });
}

void read_json_log(Input input) {
  json_log::Config config;
  config.file = log_file(input);
  config.on_bad_line = log_common::BadLine::skip;
  play([&] { return json_log::read_json_log(config); });
}

// The reader that the content asks for, as laser_log uses it.
void read_laser_log(Input input) {
  const std::filesystem::path file = log_file(input);
  static const RobotModel robot;
  try {
    const std::string name = laser_log::reader_of(file, {}).name;
    const auto make = [&]() -> std::shared_ptr<log_common::ScanPlayer> {
      const auto player = [](log_common::ScanLog log) {
        return std::make_shared<log_common::ScanPlayer>(std::move(log));
      };
      if (name == "json_log") return player(json_log::read_json_log(with_rules<json_log::Config>(file)));
      if (name == "mcap_log") return player(mcap_log::read_mcap_log(with_rules<mcap_log::Config>(file)));
      if (name == "player_log") return player(player_log::read_player_log(with_rules<player_log::Config>(file), robot));
      auto config = with_rules<carmen_log::Config>(file);
      config.poses = carmen_log::Poses::odometry;
      return player(carmen_log::read_carmen_log(config));
    };
    const double longest_m = laser_log::longest_echo_m(*make(), 30.0, {});
    promise(longest_m > 0.0 && longest_m <= 30.0, "there is a longest echo");
    laser_log::LaserLog log(make(), longest_m);
    double last_s = -std::numeric_limits<double>::infinity();
    for (SensorStep step = log.next({}); step.state == SensorState::observation; step = log.next({})) {
      check(step.observation, last_s);
      last_s = step.observation.stamp_s;
      for (const RangeReading& reading : step.observation.ranges)
        promise(std::isnan(reading.range_m) || reading.range_m <= longest_m, "an echo is no code");
    }
  } catch (const ConfigError&) {
  }
}

// Scans and motors from one file: each reader counts the other's lines as unknown.
void read_lego_log(Input input) {
  lego_log::Config config;
  config.file = log_file(input);
  config.motors = config.file;
  config.range_offset_m = 0.05;
  config.on_bad_line = log_common::BadLine::skip;
  play([&] { return lego_log::read_lego_log(config, 0.5); });
}

// Once as its topics single themselves out, and once with all of them named.
void read_mcap_log(Input input) {
  auto config = with_rules<mcap_log::Config>(log_file(input));
  play([&] { return mcap_log::read_mcap_log(config); });
  config.ranges = {"/scan", "/sonar"};
  config.odometry = "/tf";
  config.compass = "/imu";
  config.stamp = mcap_log::Stamp::log;
  play([&] { return mcap_log::read_mcap_log(config); });
}

void read_player_log(Input input) {
  static const RobotModel robot;
  player_log::Config config;
  config.file = log_file(input);
  config.on_bad_line = log_common::BadLine::skip;
  play([&] { return player_log::read_player_log(config, robot); });
}

// Columns: time, x, y, heading, three ranges; the poses once more by time from the same file.
void read_table_log(Input input) {
  static const RobotModel robot;
  TableLogConfig config;
  config.file = log_file(input);
  config.time_column = 1;
  config.x_column = 2;
  config.y_column = 3;
  config.heading_column = 4;
  config.first_range_column = 5;
  config.sonars = {{.angle_rad = 0.5}, {}, {.angle_rad = -0.5}};
  config.on_bad_line = BadLine::skip;
  play([&] { return cairn::read_table_log(config, robot); });
}

}  // namespace cairn::fuzz
