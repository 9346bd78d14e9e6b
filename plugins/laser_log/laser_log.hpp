// A laser log of any kind played back, its kind known by its content. Plugin `laser_log`, kind sensor, around the
// sensor that reads that kind; nothing to drive.
//
//   content begins with                  read by
//   {                                    json_log
//   ## Player                            player_log
//   anything else                        carmen_log: CARMEN, and pose graphs with ROBOTLASER1 scans (TORO, g2o)
//
// Odometry is what the log has of it: the raw one beside corrected poses, or the edges of its pose graph. Compressed by
// gzip or not. Lasers write many numbers for "no echo": when the greatest range of the whole log comes often, it is
// one. It says nothing here, nor do echoes from farther away than longest_m. Bad lines are skipped and counted.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "framework/config/fields.hpp"
#include "framework/contracts/sensor.hpp"

namespace cairn::laser_log {

struct Config {
  std::filesystem::path file;
  double longest_m = 30.0;

  static void describe(Fields<Config>& fields);
};

// The plugin that reads such a file, with its settings. Throws ConfigError when it cannot be read.
[[nodiscard]] PluginChoice reader_of(const std::filesystem::path& file, const Budget& budget);

// Plays a log to its end. From this range on nothing is an echo: the least of longest_m and just below the greatest
// range, when that is one reading in a thousand or more.
[[nodiscard]] double longest_echo_m(Sensor& log, double longest_m, const Budget& budget);

class LaserLog final : public Sensor {
 public:
  LaserLog(std::shared_ptr<Sensor> source, double longest_m) : source_(std::move(source)), longest_m_(longest_m) {}

  SensorStep next(const Budget& budget) override;
  [[nodiscard]] std::optional<Pose2> start() const override { return source_->start(); }
  [[nodiscard]] const GroundTruthSource* truth() const override { return source_->truth(); }

 private:
  std::shared_ptr<Sensor> source_;
  double longest_m_;
};

}  // namespace cairn::laser_log
