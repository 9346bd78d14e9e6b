// Sonar readings derived from a laser: plugin `sonar_from_laser`, kind sensor, around another sensor.
//
// For each scan of the source and each sonar of the robot file: the nearest laser echo in the sonar's
// cone, measured from the sonar. No real sonar answers so: these echoes come from walls that a sound
// would glance off, and a laser sees thin things that a sonar would miss. Call results derived.
//
//   echoes in the cone                 the nearest one; nearer than min_m: -inf, beyond max_m: +inf
//   beams in the cone, but no echo     +inf, no echo
//   no beam in the cone                the sonar is left out: the laser cannot see there
// A beam is in the cone when its echo is; without an echo, when it crosses the cone's arc at max_m. Bad
// readings (NaN) and those nearer than the laser can measure count as no beam. All sonars of a scan fire at
// once. Stamps, odometry, compass, start, drive and ground truth are the source's own.
#pragma once

#include <memory>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/sensor.hpp"

namespace cairn::sonar_from_laser {

struct Config {
  PluginChoice source;

  static void describe(Fields<Config>& fields);
};

class SonarFromLaser final : public Sensor {
 public:
  // Throws std::invalid_argument when the robot has no sonars.
  SonarFromLaser(std::shared_ptr<Sensor> source, std::vector<SonarModel> sonars);

  SensorStep next(const Budget& budget) override;
  Drive* drive() override { return source_->drive(); }
  [[nodiscard]] std::optional<Pose2> start() const override { return source_->start(); }
  [[nodiscard]] const GroundTruthSource* truth() const override { return source_->truth(); }

 private:
  std::shared_ptr<Sensor> source_;
  std::vector<SonarModel> sonars_;
};

}  // namespace cairn::sonar_from_laser
