// A Pioneer's microcontroller on a pseudo-terminal, with a watchdog of two seconds, after which the wheels turn again
// with the next packet, as P2OS's do. A sonar fires every 40 ms.
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
  std::atomic<bool> is_doubling{false};  // every packet
  std::atomic<int> first_sonar{0};       // their numbers begin with that
  std::atomic<double> say_every_s{0.05};
  std::atomic<double> watchdog_s{2.0};
  std::atomic<int> stall_and_bumpers{0};
  std::atomic<int> flags{0};  // 1: the motors are on; 0x20: its emergency button is pressed

  [[nodiscard]] bool is_in_session() const { return is_in_session_; }
  [[nodiscard]] double v_mps() const { return v_mm_ / 1000.0; }
  [[nodiscard]] double w_degps() const { return w_deg_; }
  // Pulls the cable out, and plugs it in again: as another device.
  void unplug() { plug(false); }
  void plug_in() { plug(true); }
  // Waits for the wheels to turn, or to stand; how long it took, none: not within so long.
  [[nodiscard]] std::optional<double> wait_for_wheels(bool turning, double within_s) const;
  // Forwards less backwards, by its wheels.
  [[nodiscard]] double driven_m() const { return driven_m_; }
  // How often it was ordered to switch the motors on.
  [[nodiscard]] int enables() const { return enables_; }
  [[nodiscard]] int commands() const { return commands_; }

 private:
  void open_terminal();
  void close_terminal();
  // Returns when it is done.
  void plug(bool is_in);
  void turn_wheels(double now_s);
  void run(const std::stop_token& ended);
  void obey(const std::vector<std::uint8_t>& data);
  [[nodiscard]] std::vector<std::uint8_t> answer_to(int synchronisation) const;
  void say(const std::vector<std::uint8_t>& data);
  void say_information();

  std::string subclass_;
  int terminal_ = -1;
  int held_ = -1;  // the other end, so that the terminal is there without a client
  std::atomic<bool> is_plugged_in_{true};
  std::atomic<bool> wants_plugged_in_{true};
  std::string device_;
  std::atomic<bool> is_in_session_{false};
  std::atomic<int> v_mm_{0};  // of the wheels
  std::atomic<int> w_deg_{0};
  int ordered_v_mm_ = 0;  // which the wheels do again with the next packet after the watchdog has stopped them
  int ordered_w_deg_ = 0;
  std::atomic<int> commands_{0};
  std::atomic<int> enables_{0};
  std::atomic<double> driven_m_{0.0};
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
