// The way to one kind of base: a serial protocol, a network. What all live robots share is in live_robot.hpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "framework/contracts/observation.hpp"
#include "framework/contracts/optional/connection_report.hpp"

namespace cairn {
class MissionDisplay;
}

namespace cairn::live {

class BaseLink {
 public:
  virtual ~BaseLink() = default;
  // For people: "the robot at /dev/ttyUSB0".
  [[nodiscard]] virtual std::string name() const = 0;
  // What connect() waits for, for people: "/odom in ROS domain 0". From any thread.
  [[nodiscard]] virtual std::string awaited() const { return name(); }

  // By the thread of the mission. ---------------------------------------------------------------------------------
  // Makes the connection, with the wheels ordered to stand first. False: not now, why says for what reason. Looks at
  // the budget every 20 ms. Throws std::runtime_error when it makes no sense to try again.
  [[nodiscard]] virtual bool connect(const Budget& budget, std::string& why) = 0;
  virtual void disconnect() = 0;
  // Adds what has come, in order of time, stamped by now_s(); waits for it a short time, 20 ms at most. False: the
  // other end is gone. Throws std::runtime_error with what came that makes no sense.
  [[nodiscard]] virtual bool receive(std::vector<Observation>& seen) = 0;

  // Where the robot begins in the map frame, when the other end says so; may wait for that, and returns
  // nothing when that is cancelled. Throws std::runtime_error.
  [[nodiscard]] virtual std::optional<Pose2> start() { return std::nullopt; }
  // What start() waits for, for people; empty: it returns at once. From any thread.
  [[nodiscard]] virtual std::string awaited_start() const { return {}; }
  // Where the mission is shown; null: nowhere. A part of the link; by the same thread.
  [[nodiscard]] virtual MissionDisplay* display() { return nullptr; }
  // What it is connected to, part by part (framework/contracts/optional/connection_report.hpp); by the same thread.
  [[nodiscard]] virtual std::vector<ConnectionPart> parts() { return {}; }

  // By the thread that sends, while connected, beside receive(). ---------------------------------------------------
  virtual void send(const Twist& twist) noexcept = 0;
  // Nothing to send, but the mission lives.
  virtual void send_pulse() noexcept = 0;
  // 20 times a second, whatever happens: this process lives.
  virtual void beat() noexcept {}

  // From any thread and from a signal handler, connected or not: the wheels stand. False: this link cannot send from
  // there, and the thread that sends does so within 50 ms. ----------------------------------------------------------
  virtual bool send_stop() noexcept = 0;
};

}  // namespace cairn::live
