// Answers on the control socket of a running mission, in a thread of its own.
#pragma once

#include <filesystem>
#include <string>
#include <thread>

#include "framework/host/run_control.hpp"
#include "framework/program/control_socket.hpp"

namespace cairn {

// The answer to one command, as one line of JSON. Waits until what it asks for has come about, within limits.
[[nodiscard]] std::string answer_to(const std::string& command, RunControl& control);

class ControlServer {
 public:
  // The control must outlive it. Throws std::runtime_error when it cannot listen there.
  ControlServer(std::filesystem::path folder, RunControl& control);
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;
  // Takes the socket away. Waits for an answer under way: the mission must have ended or not begun.
  ~ControlServer();

 private:
  void serve();
  void answer(int connection);

  std::filesystem::path folder_;
  RunControl& control_;
  Descriptor listening_;
  Descriptor ending_;  // readable when it is to end
  std::thread thread_;
};

}  // namespace cairn
