// Answers on the control socket of a running mission, in threads of its own: one listens, and every command has one, so
// that nobody's "cancel" waits for the answer to another's "resume".
#pragma once

#include <atomic>
#include <filesystem>
#include <list>
#include <string>
#include <thread>

#include "framework/mission/run_control.hpp"
#include "framework/program/mission/control_socket.hpp"

namespace cairn {

// The answer to one command, as one line of JSON. Waits until what it asks for has come about, within limits.
[[nodiscard]] std::string answer_to(const std::string& command, RunControl& control);

class ControlServer {
 public:
  // The control must outlive it. Throws std::runtime_error when it cannot listen there, std::system_error when there is
  // no thread or descriptor left.
  ControlServer(std::filesystem::path folder, RunControl& control);
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;
  // Removes the socket. Waits for answers in progress: the mission must have ended or not begun.
  ~ControlServer();

 private:
  struct Answer {
    std::atomic<bool> is_given = false;
    std::jthread thread{};
  };
  void serve();
  void take(Descriptor connection);
  void answer(int connection);

  std::filesystem::path folder_;
  RunControl& control_;
  Descriptor listening_;
  Descriptor ending_;          // readable when it is to end
  std::list<Answer> answers_;  // under way, of the listening thread
  std::thread thread_;
};

}  // namespace cairn
