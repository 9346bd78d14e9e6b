// What every robot that really drives needs, whatever the way to it: orders that count for a time, a wheel that stands
// when nobody asks it to turn any more, senses that have gone silent, connections that come back.
//
// The base sets the pace: next() waits for it. A thread of its own sends velocities 20 times a second: zero as soon as
// an order is older than `order_older_s` or the base has been silent for `silent_s`, and half a second longer; then it
// only says that the mission lives, and only while it does.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "framework/config/fields.hpp"
#include "framework/contracts/optional/command_silence.hpp"
#include "framework/contracts/optional/connection_report.hpp"
#include "framework/contracts/optional/stop_report.hpp"
#include "framework/contracts/optional/wait_report.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/sensor.hpp"
#include "framework/live/base_link.hpp"
#include "framework/live/velocity_orders.hpp"

namespace cairn::live {

struct LiveRules {
  double order_older_s = 0.3;
  double silent_s = 0.3;
  double reconnect_s = 10.0;

  static void describe(Fields<LiveRules>& fields);
};

class LiveRobot final : public Sensor,
                        public Drive,
                        public StopReport,
                        public ConnectionReport,
                        public WaitReport,
                        public CommandSilence {
 public:
  // Connects when it is used first.
  LiveRobot(std::unique_ptr<BaseLink> link, const LiveRules& rules, const RobotModel& robot);
  ~LiveRobot() override;
  LiveRobot(const LiveRobot&) = delete;
  LiveRobot& operator=(const LiveRobot&) = delete;

  // A call that its budget ends is a fault that says so, and the next one goes on.
  SensorStep next(const Budget& budget) override;
  Drive* drive() override { return this; }
  [[nodiscard]] std::optional<Pose2> start() const override;
  MissionDisplay* display() override { return link_->display(); }
  std::vector<ConnectionPart> connection_parts() override { return link_->parts(); }
  [[nodiscard]] std::string waits_for() const override;

  // Throws std::invalid_argument when not finite.
  void command(const Twist& twist, double valid_for_s) override;
  void stop() noexcept override;
  void be_silent(double for_s) override;
  [[nodiscard]] bool is_stop_sent() const noexcept override { return stops_sent_ >= stops_; }

 private:
  // The observations that have come, as one; connects and waits up to some ms for them.
  [[nodiscard]] std::optional<Observation> wait_for_observation(const Budget& budget);
  void disconnect(const std::string& why);
  void note_wait(std::optional<double> since_s);
  void send_orders(const std::stop_token& ended);
  void send_what_counts(double now_s);

  std::unique_ptr<BaseLink> link_;
  LiveRules rules_;
  RobotModel robot_;
  std::string disconnect_reason_;  // why it is not connected
  std::string fault_;              // that has ended it
  VelocityOrders orders_;
  std::atomic<double> heard_s_{0.0};          // when the base was last heard
  std::atomic<double> silent_until_s_{0.0};   // nothing is sent
  std::atomic<double> asked_s_{0.0};          // when the mission last asked for anything
  std::atomic<std::uint64_t> stops_{0};       // that the thread that sends is to send
  std::atomic<std::uint64_t> stops_sent_{0};  // of these
  mutable std::mutex waiting_;
  mutable std::atomic<bool> waits_for_start_{false};
  std::optional<double> waits_since_s_;  // what next() waits for, while it does
  std::string wait_reason_;
  std::mutex sending_;  // and whether it is connected
  bool is_connected_ = false;
  std::condition_variable_any ordered_;
  bool is_ordered_ = false;
  // Of the sender:
  Twist sent_{};
  double sent_s_ = 0.0;
  double moved_s_ = 0.0;
  double pulsed_s_ = 0.0;
  std::jthread sender_;  // last: it uses all of the above
};

}  // namespace cairn::live
