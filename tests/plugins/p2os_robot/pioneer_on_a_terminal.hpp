// A Pioneer's microcontroller on a pseudo-terminal, with a watchdog of two seconds. A sonar fires every 40 ms.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/plugins/p2os_robot/pioneer_body.hpp"

namespace cairn::p2os_robot {

class PioneerOnATerminal {
 public:
  explicit PioneerOnATerminal(std::string subclass = "p3dx-sh",
                              std::unique_ptr<PioneerBody> body = std::make_unique<FreeBody>());
  ~PioneerOnATerminal();

  [[nodiscard]] const std::string& device() const { return device_; }
  // What it does from now on.
  std::atomic<bool> is_silent{false};
  std::atomic<bool> is_damaging{false};  // every third packet
  std::atomic<int> first_sonar{0};       // their numbers begin with that
  std::atomic<double> say_every_s{0.05};
  std::atomic<double> watchdog_s{2.0};
  std::atomic<int> stall_and_bumpers{0};

  [[nodiscard]] bool is_in_session() const { return is_in_session_; }
  [[nodiscard]] double v_mps() const { return v_mm_ / 1000.0; }
  // Waits for the wheels to turn, or to stand; how long it took, none: not within so long.
  [[nodiscard]] std::optional<double> wait_for_wheels(bool turning, double within_s) const;
  [[nodiscard]] int commands() const { return commands_; }

 private:
  void run(const std::stop_token& ended);
  void obey(const std::vector<std::uint8_t>& data);
  [[nodiscard]] std::vector<std::uint8_t> answer_to(int synchronisation) const;
  void say(const std::vector<std::uint8_t>& data);
  void say_information();

  std::string subclass_;
  int terminal_;
  int held_;  // the other end, so that the terminal is there without a client
  std::string device_;
  std::atomic<bool> is_in_session_{false};
  std::atomic<int> v_mm_{0};
  std::atomic<int> w_deg_{0};
  std::atomic<int> commands_{0};
  std::unique_ptr<PioneerBody> body_;
  std::vector<std::pair<int, double>> heard_;  // sonars with their ranges, since the last packet
  int next_sonar_ = 0;
  double fired_s_ = 0.0;
  double heard_s_ = 0.0;
  int synchronised_ = 0;  // of the three packets that begin a session
  int packets_ = 0;
  std::jthread thread_;
};

}  // namespace cairn::p2os_robot
