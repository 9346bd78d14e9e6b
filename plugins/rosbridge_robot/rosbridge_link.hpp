// A robot behind a rosbridge_server.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "framework/live/base_link.hpp"
#include "framework/live/descriptor.hpp"
#include "framework/live/guard_process.hpp"
#include "plugins/common/ros/robot_observer.hpp"
#include "plugins/rosbridge_robot/config.hpp"
#include "plugins/rosbridge_robot/fragments.hpp"
#include "plugins/rosbridge_robot/known_topics.hpp"
#include "plugins/rosbridge_robot/subscriptions.hpp"
#include "plugins/rosbridge_robot/web_socket.hpp"

namespace cairn::rosbridge_robot {

// Two connections: one for all that is read and ordered; one that orders the wheels to stand, by a signal handler or by
// the process that guards them, so that a message which was cut in two by a signal is never in its way.
class RosbridgeLink final : public live::BaseLink {
 public:
  // Throws std::invalid_argument with a setting that cannot be.
  RosbridgeLink(const Config& config, const RobotModel& robot);
  ~RosbridgeLink() override;

  [[nodiscard]] std::string name() const override { return "the robot at " + address_.text(); }
  [[nodiscard]] std::string awaited() const override { return config_.odometry + " of " + name(); }
  // Until the odometry comes, two seconds at most.
  [[nodiscard]] bool connect(const Budget& budget, std::string& why) override;
  void disconnect() override;
  [[nodiscard]] bool receive(std::vector<Observation>& seen) override;
  [[nodiscard]] std::vector<ConnectionPart> parts() override;
  void send(const Twist& twist) noexcept override;
  void send_pulse() noexcept override {}
  void beat() noexcept override;
  bool send_stop() noexcept override;

 private:
  [[nodiscard]] bool open_sockets(const Budget& budget, std::string& why);
  void set_up();
  void make_guard();
  void take_all(std::chrono::milliseconds wait_for, std::vector<Observation>& seen);
  // is_whole: it was put together of pieces.
  void take(const std::string& text, bool is_whole, std::vector<Observation>& seen);
  void take_status(const nlohmann::json& message);
  [[nodiscard]] std::string nobody_there() const;
  [[nodiscard]] ConnectionPart server_part() const;
  [[nodiscard]] ConnectionPart topic_part(const Subscriptions::Topic& topic, double now_s) const;
  [[nodiscard]] ConnectionPart velocity_part() const;

  Config config_;
  RobotModel robot_;
  WebAddress address_;
  ros::RobotObserver observer_;
  Subscriptions subscriptions_;
  KnownTopics known_;
  Fragments fragments_;
  std::vector<std::uint8_t> stop_frame_;
  // One descriptor for life, so that send_stop() never writes to another file: while not connected it is `nowhere_`.
  Descriptor nowhere_;
  Descriptor stop_line_;
  std::unique_ptr<WebSocket> socket_;
  std::unique_ptr<WebSocket> stop_socket_;
  bool is_set_up_ = false;
  std::vector<Observation> first_;  // seen while connecting
  std::unique_ptr<live::GuardProcess> guard_;
  std::mutex guarding_;
  int not_understood_ = 0;
  std::string closed_why_;
  std::string last_warning_;
};

}  // namespace cairn::rosbridge_robot
