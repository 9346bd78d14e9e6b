// The topics that pictures come by.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "plugins/common/ros/heard_topics.hpp"
#include "plugins/ros2_robot/config.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"

namespace cairn::ros2_robot {

class ImageTopics {
 public:
  // They must outlive it. wants_images: without it nothing is subscribed to. Throws std::invalid_argument when the
  // robot's file has no such camera.
  ImageTopics(const Config& config, const RobotModel& robot, bool wants_images);

  void open(const Participant& participant);
  // What has come. Cameras damage a picture now and then: kMaxDamaged in sequence are an error. Throws
  // std::runtime_error with the topic and what about its pictures cannot be.
  void take(ros::HeardTopics& heard);
  // Moves those that wait and are not younger into an observation; said_s: its stamp as the robot says it, before it
  // is made to go on. Younger ones wait for the next. Left out are those that are more than kMaxBehind_s older or
  // kMaxAhead_s younger: the robot was elsewhere, or the clocks differ.
  void move_into(Observation& observation, double said_s);
  // In the order of the settings.
  [[nodiscard]] const std::vector<Entity>& readers() const { return readers_; }

  static constexpr double kMaxBehind_s = 1.0;
  static constexpr double kMaxAhead_s = 0.3;
  static constexpr int kMaxDamaged = 10;

 private:
  // Null: a damaged one, which is left out. i: of the topic.
  template <class Message>
  [[nodiscard]] std::optional<CameraImage> undamaged(const Message& message, std::size_t i);

  const Config& config_;
  const RobotModel& robot_;
  bool wants_images_;
  std::vector<int> damaged_;  // in sequence, by topic
  std::vector<Entity> readers_;
  std::vector<CameraImage> waiting_;
};

}  // namespace cairn::ros2_robot
