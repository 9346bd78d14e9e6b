// Answers on the control socket of a running mission. One thread listens, takes connections in and reads their commands
// as they come, so that a crowd that connects and sends nothing holds nobody up; every command is answered in a thread
// of its own, so that nobody's "cancel" waits for the answer to another's "resume".
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <list>
#include <string>
#include <thread>

#include "framework/mission/run_control.hpp"
#include "framework/program/mission/control_socket.hpp"
#include "framework/program/mission/watch_stream.hpp"

namespace cairn {

// The answer to one command, as one line of JSON. Waits until what it asks for has come about, within limits, or says
// at once how the mission stands.
enum class Waiting { until_done, not_at_all };
[[nodiscard]] std::string answer_to(const std::string& command, RunControl& control,
                                    Waiting waiting = Waiting::until_done);

// What those get who ask to watch. Null: nobody may.
struct Watching {
  WatchSource* source = nullptr;
  std::string first_line{};
};

class ControlServer {
 public:
  // Control and source must outlive it. Throws std::runtime_error when it cannot listen there, std::system_error when
  // there is no thread or descriptor left.
  ControlServer(std::filesystem::path folder, RunControl& control, Watching watching = {});
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;
  // Removes the socket. Waits for answers in progress: the mission must have ended or not begun, and its source with
  // it.
  ~ControlServer();

 private:
  struct Caller {  // who has not sent a command yet
    Descriptor connection;
    std::chrono::steady_clock::time_point until;
    std::string text{};
  };
  struct Answer {
    bool is_status = false;
    std::atomic<bool> is_given = false;
    std::jthread thread{};
  };
  void serve();
  [[nodiscard]] bool wait_for_callers();  // false: it is to end
  void accept_clients();
  void read_callers();
  // False when nothing more is to be heard from the caller.
  bool read_caller(Caller& caller);
  void begin_answer(Descriptor connection, const std::string& command);
  void begin_watch(Descriptor connection, const std::string& command);

  std::filesystem::path folder_;
  RunControl& control_;
  Descriptor listening_;
  Descriptor ending_;          // readable when it is to end
  std::list<Caller> callers_;  // of the listening thread, like the answers; the longest there first
  std::list<Answer> answers_;  // under way
  const Watching watching_;
  std::list<WatchStream> streams_;
  std::thread thread_;
};

}  // namespace cairn
