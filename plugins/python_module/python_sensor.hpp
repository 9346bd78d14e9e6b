// A sensor written in Python: a source of observations without a drive. Plugin `python`, kind sensor.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/ground_truth.hpp"
#include "framework/contracts/sensor.hpp"
#include "plugins/python_module/python_object.hpp"

namespace cairn::python_module {

class PythonSensor : public Sensor, private GroundTruthSource {
 public:
  PythonSensor(const Config& config, const SensorContext& context);
  // Calls next() of the class: a dict, or None when the data is over.
  SensorStep next(const Budget& budget) override;
  // What start() of the class has returned when this was made; none without that method.
  [[nodiscard]] std::optional<Pose2> start() const override { return start_; }
  // Of classes that set `knows_truth`.
  [[nodiscard]] const GroundTruthSource* truth() const override { return knows_truth_ ? this : nullptr; }

 private:
  [[nodiscard]] std::optional<GroundTruth> last_truth() const override { return truth_; }
  [[nodiscard]] Observation observation_from(const pybind11::handle& value);

  PythonObject object_;
  std::vector<RangeReading> transducers_;  // of the robot: sonars, then beams
  std::optional<Pose2> start_;
  bool knows_truth_ = false;
  std::optional<GroundTruth> truth_;
  bool has_ended_ = false;
};

}  // namespace cairn::python_module
