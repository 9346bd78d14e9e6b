// Recorded pictures beside a recorded log: each one goes with the first observation that is not before it.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "framework/contracts/sensor.hpp"

namespace cairn::pictures {

struct RecordedPicture {
  double stamp_s = 0.0;         // by the log's clock
  std::size_t observation = 0;  // that it may go with at the earliest, counted from 0
  // The picture with its camera; throws std::runtime_error with the reason that it cannot be read.
  std::function<CameraImage()> read;
};

// A log with pictures. One that is more than kMaxBehind_s older than its observation is left out and counted: the robot
// was elsewhere. One that cannot be read is a fault.
class PicturePlayer final : public Sensor {
 public:
  static constexpr double kMaxBehind_s = 1.0;

  // The pictures in their order of time.
  PicturePlayer(std::shared_ptr<Sensor> log, const std::vector<RecordedPicture>& pictures)
      : log_(std::move(log)), pictures_(pictures.begin(), pictures.end()) {}

  SensorStep next(const Budget& budget) override;
  Drive* drive() override { return log_->drive(); }
  [[nodiscard]] std::optional<Pose2> start() const override { return log_->start(); }
  [[nodiscard]] const GroundTruthSource* truth() const override { return log_->truth(); }
  [[nodiscard]] MissionDisplay* display() override { return log_->display(); }

 private:
  std::shared_ptr<Sensor> log_;
  std::deque<RecordedPicture> pictures_;
  std::size_t observation_ = 0;
  std::size_t left_out_ = 0;
};

}  // namespace cairn::pictures
