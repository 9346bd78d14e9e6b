// A laser log of any kind played back, its kind known by its content. Plugin `laser_log`, kind sensor, around the
// sensor that reads that kind; nothing to drive.
//
//   its first line that says so                        read by
//   { ...                                              json_log
//   ## Player, or TIME HOST ROBOT INTERFACE ...        player_log
//   \x89MCAP0                                    mcap_log
//   FLASER, ROBOTLASER1, LASER_READING, VERTEX2, ...   carmen_log, also when no line says so
//
// Odometry is what the log has of it: the raw one beside corrected poses, or the edges of its pose graph. Compressed by
// gzip or not. Lasers write many numbers for "no echo": when the greatest range of the whole log comes often and stands
// alone, it is one. It says nothing here, nor do echoes from farther away than longest_m or nearer than a laser
// measures. Bad lines are skipped and counted.
//
// With `sonars` above 0 each scan becomes the readings that so many sonars spread over the laser's field might have
// had: derived data (plugins/common/logs/derived_sonar.hpp). Readings of wide beams stay as they are. With
// `worsen` the odometry becomes that of worn wheels.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "framework/config/fields.hpp"
#include "framework/contracts/sensor.hpp"
#include "plugins/laser_log/worsened_odometry.hpp"

namespace cairn::laser_log {

struct Config {
  std::filesystem::path file;
  double longest_m = 30.0;
  int sonars = 0;
  double sonar_half_beam_rad = radians(7.5);
  double sonar_max_m = 5.0;
  WornWheels worsen;

  static void describe(Fields<Config>& fields);
};

// The plugin that reads such a file, with its settings. Throws ConfigError when it cannot be read.
[[nodiscard]] PluginChoice reader_of(const std::filesystem::path& file, const Budget& budget);

// Plays a log to its end. From this range on nothing is an echo: longest_m, or just below the greatest range up to
// there when that is one reading in a thousand or more, and three times as frequent as those 0.5 to 5 % below it.
[[nodiscard]] double longest_echo_m(Sensor& log, double longest_m, const Budget& budget);

class LaserLog final : public Sensor {
 public:
  LaserLog(std::shared_ptr<Sensor> source, double longest_m, const Config& config = {})
      : source_(std::move(source)), longest_m_(longest_m), config_(config), odometry_(config.worsen) {}

  SensorStep next(const Budget& budget) override;
  [[nodiscard]] std::optional<Pose2> start() const override { return source_->start(); }
  [[nodiscard]] const GroundTruthSource* truth() const override { return source_->truth(); }

 private:
  std::shared_ptr<Sensor> source_;
  double longest_m_;
  Config config_;
  WorsenedOdometry odometry_;
};

}  // namespace cairn::laser_log
