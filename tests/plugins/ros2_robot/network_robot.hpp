// A robot on a ROS 2 network that stands, fifty times a second: another participant of the same domain, on this
// computer only.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "framework/live/steady_time.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"
#include "plugins/ros2_robot/messages.hpp"

namespace cairn::ros2_robot {

class NetworkRobot {
 public:
  explicit NetworkRobot(int domain)
      : participant_({domain, true, "", {}}),
        odometry_(participant_.writer("/odom", nav_msgs_msg_dds__Odometry__desc)),
        sonar_(participant_.writer("/sonar", sensor_msgs_msg_dds__Range__desc)),
        thread_([this](const std::stop_token& ended) { publish(ended); }) {}

  std::atomic<double> sonar_ahead_s{0.0};  // its clock of the odometry's
  std::atomic<bool> is_sonar_silent{false};

  [[nodiscard]] const Participant& participant() const { return participant_; }
  // For what has other qualities than a robot's.
  [[nodiscard]] dds_entity_t handle() const { return dds_get_participant(odometry_.get()); }

 private:
  void publish(const std::stop_token& ended) const {
    while (!ended.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      const double now_s = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
      char sonar_frame[] = "sonar_0";
      Range range{};
      range.header = {time_of(now_s + sonar_ahead_s), sonar_frame};
      range.min_range = 0.1F;
      range.max_range = 5.0F;
      range.range = 2.0F;
      if (!is_sonar_silent) (void)dds_write(sonar_.get(), &range);
      char frame[] = "odom";
      char base[] = "base_link";
      Odometry odometry{};
      odometry.header = {time_of(now_s), frame};
      odometry.child_frame_id = base;
      odometry.pose.pose.orientation.w = 1.0;
      (void)dds_write(odometry_.get(), &odometry);
    }
  }

  Participant participant_;
  Entity odometry_;
  Entity sonar_;
  std::jthread thread_;
};

}  // namespace cairn::ros2_robot
