// A robot on a ROS 2 network.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "framework/live/base_link.hpp"
#include "framework/live/guard_process.hpp"
#include "plugins/common/ros/robot_observer.hpp"
#include "plugins/ros2_robot/config.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"
#include "plugins/ros2_robot/dds/velocity_topic.hpp"
#include "plugins/ros2_robot/display_topics.hpp"
#include "plugins/ros2_robot/image_topics.hpp"
#include "plugins/ros2_robot/messages.hpp"
#include "plugins/ros2_robot/network.hpp"
#include "plugins/ros2_robot/range_topics.hpp"

namespace cairn::ros2_robot {

class RosLink final : public live::BaseLink {
 public:
  // Throws std::invalid_argument with a setting or a variable of the environment that cannot be. The budget is of
  // start(). guard: the program that guards the wheels (guard.cpp); empty: none does.
  RosLink(const Config& config, const RobotModel& robot, const Budget& budget, std::filesystem::path guard,
          bool wants_images);

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string awaited() const override;
  // Until the odometry comes, two seconds at most.
  [[nodiscard]] bool connect(const Budget& budget, std::string& why) override;
  void disconnect() override;
  [[nodiscard]] bool receive(std::vector<Observation>& seen) override;
  // Waits for it where the settings say so.
  [[nodiscard]] std::optional<Pose2> start() override;
  [[nodiscard]] std::string awaited_start() const override;
  [[nodiscard]] MissionDisplay* display() override { return &display_; }
  [[nodiscard]] std::vector<ConnectionPart> parts() override;
  void send(const Twist& twist) noexcept override;
  void send_pulse() noexcept override {}
  void beat() noexcept override;
  // DDS cannot be asked from a signal handler: the thread that sends does so within 50 ms; the guard, when this process
  // is killed or halted.
  bool send_stop() noexcept override { return false; }

 private:
  void make_endpoints();
  void take_frames();
  void take_others();
  void take_odometry(std::vector<Observation>& seen);
  // Makes one when there is none any more.
  void make_guard();
  // Of a topic that nobody publishes, or not as it should be.
  [[nodiscard]] std::string nobody_there(const std::string& topic);
  // Peers that no name service knows; empty: all are known. Asks once, which may take seconds.
  [[nodiscard]] const std::string& about_peers();
  // Throws std::runtime_error when nobody has published a topic with ranges since it was connected, for as long as it
  // waits for a robot.
  void check_ranges_are_there(double now_s);
  // Throws std::runtime_error when two send the odometry by turns.
  void check_publisher(dds_instance_handle_t publisher, double now_s);

  Config config_;
  ChosenNetwork chosen_;
  RobotModel robot_;
  Budget budget_;
  std::filesystem::path guard_program_;
  std::optional<Participant> participant_;
  Entity odometry_;
  Entity compass_;
  Entity battery_;
  Entity static_frames_;
  std::vector<Entity> bumpers_;
  Entity emergency_;
  RangeTopics ranges_;
  ImageTopics images_;
  std::optional<VelocityTopic> velocity_;
  std::unique_ptr<live::GuardProcess> guard_;
  std::mutex guarding_;
  dds_instance_handle_t publisher_ = 0;  // of the odometry
  dds_instance_handle_t publisher_before_ = 0;
  double publisher_changed_s_ = 0.0;
  ros::RobotObserver observer_;
  DisplayTopics display_;
  std::optional<std::string> about_peers_;
  bool is_reading_ = false;               // since the odometry was met
  std::optional<double> ranges_until_s_;  // they are waited for; none: they were there
};

}  // namespace cairn::ros2_robot
