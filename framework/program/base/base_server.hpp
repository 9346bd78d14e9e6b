// Serves a robot on a socket, in wall-clock time, one client at a time, and goes on without one.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "framework/live/line_socket.hpp"
#include "framework/live/served_robot.hpp"
#include "maps/base/output_file.hpp"

namespace cairn {

struct BaseOptions {
  double pace = 1.0;          // simulated seconds a second; 0: an observation each time that the client asks
  std::filesystem::path log;  // one line a tick; empty: none
};

class BaseServer {
 public:
  // Throws std::runtime_error when it cannot listen or write its log.
  BaseServer(live::ServedRobot& robot, const live::Address& address, const BaseOptions& options);
  ~BaseServer();
  BaseServer(const BaseServer&) = delete;
  BaseServer& operator=(const BaseServer&) = delete;

  // Until `end` or a fault of the robot, which is thrown as std::runtime_error once the client has it.
  void run(const std::atomic<bool>& end);

 private:
  using Clock = std::chrono::steady_clock;

  void wait_until(Clock::time_point due, const std::atomic<bool>& end);
  void read_client();
  void accept_client();
  void lose_client();
  void tick();
  void schedule(double stamp_s);
  void write_log(const live::ServedRobot::Tick& tick);

  live::ServedRobot& robot_;
  live::Address address_;
  double pace_;
  Descriptor listening_;
  std::unique_ptr<GrowingFile> log_;  // null: none
  Descriptor client_;
  live::LineReader reader_;
  live::LineWriter writer_;
  Clock::time_point due_ = Clock::now();
  std::optional<double> stamp_s_;  // of the last tick
};

}  // namespace cairn
