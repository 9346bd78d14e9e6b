// A robot as a base serves it: lines of a client go in, lines for it come out (framework/live/wire.hpp).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "framework/contracts/ground_truth.hpp"
#include "framework/contracts/sensor.hpp"
#include "framework/live/command_timer.hpp"

namespace cairn::live {

class ServedRobot {
 public:
  // The model must outlive it. Throws std::runtime_error when the source cannot be driven.
  ServedRobot(std::shared_ptr<Sensor> robot, const RobotModel& model);

  // What a client says. A line that cannot be read stops the robot and is answered; empty: no answer.
  [[nodiscard]] std::string take(const std::string& line);
  // When the client is gone, or says what cannot be read.
  void stop();
  // The client waits for an observation: for a base that has no time of its own. Asked once, forgotten then.
  [[nodiscard]] bool take_request();

  struct Tick {
    std::string line;     // for the client
    std::string fault{};  // there is nothing more to come
    double stamp_s = 0.0;
    Twist ordered{};                // for the time up to this tick
    std::optional<Twist> driven{};  // really, where the source knows it
  };
  [[nodiscard]] Tick tick();

 private:
  [[nodiscard]] std::optional<Twist> driven(double stamp_s) const;

  std::shared_ptr<Sensor> robot_;
  const RobotModel& model_;
  CommandTimer orders_;
  double stamp_s_ = 0.0;
  std::optional<Pose2> T_map_robot_;
  bool is_asked_ = false;
};

}  // namespace cairn::live
