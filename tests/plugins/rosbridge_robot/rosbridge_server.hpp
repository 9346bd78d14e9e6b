// A rosbridge_server with a robot behind it, for tests: the operations of its protocol, and whatever odd servers do.
// The wheels turn as they were ordered last: this base has no time-out of its own.
#pragma once

#include <atomic>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cairn::rosbridge_robot {

class RosbridgeServer {
 public:
  // Of ROS 1 or 2, at a port of its own on this computer.
  explicit RosbridgeServer(int ros = 2);
  ~RosbridgeServer();
  RosbridgeServer(const RosbridgeServer&) = delete;
  RosbridgeServer& operator=(const RosbridgeServer&) = delete;

  [[nodiscard]] int port() const;
  // Every connection is cut without a word.
  void cut();
  // Said to all once, as it stands.
  void say(const std::string& text);
  void say_binary(const std::string& bytes);
  // What was asked for, of that operation.
  [[nodiscard]] std::vector<nlohmann::json> requests(const std::string& op) const;
  [[nodiscard]] int connections() const;

  [[nodiscard]] bool stands_within(double within_s) const { return wait_for_wheels(false, within_s); }
  [[nodiscard]] bool drives_within(double within_s) const { return wait_for_wheels(true, within_s); }
  std::atomic<double> v_mps{0.0};

  std::atomic<bool> is_silent{false};      // publishes nothing
  std::atomic<bool> in_pieces{false};      // all messages as fragments
  std::atomic<bool> with_noise{false};     // unknown operations and text that is no JSON in between
  std::atomic<bool> is_deaf_sonar{false};  // /sonar is published to those only who ask for it from now on
  std::atomic<bool> has_rosapi{true};
  std::atomic<bool> wants_stamped{false};  // the base listens to TwistStamped
  std::atomic<double> range_m{2.0};        // not finite: null

 private:
  [[nodiscard]] bool wait_for_wheels(bool turning, double within_s) const;
  struct Loop;
  std::shared_ptr<Loop> loop_;
};

}  // namespace cairn::rosbridge_robot
