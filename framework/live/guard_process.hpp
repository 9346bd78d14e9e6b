// A process of its own that stops the wheels when this one cannot: killed, stopped by a signal, or hanging as a whole.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "framework/live/descriptor.hpp"

namespace cairn::live {

class GuardProcess {
 public:
  // watch: in the new process, which has one thread only and may do what a signal handler may, or exec; it hears beats
  // on that descriptor (watch_beats). The process ends when it returns. Ctrl-C and Ctrl-Z do not reach it. Throws
  // std::runtime_error when no process can be made.
  explicit GuardProcess(const std::function<void(int beats)>& watch);
  // Waits until it has ended.
  ~GuardProcess();
  GuardProcess(const GuardProcess&) = delete;
  GuardProcess& operator=(const GuardProcess&) = delete;

  // This process lives; note: what the guard is told with it. Without waiting.
  void beat(double note = 0.0) noexcept;
  // False once a beat has found that the guard has ended.
  [[nodiscard]] bool is_there() const { return is_there_; }

 private:
  Descriptor beats_;
  int process_ = -1;
  std::atomic<bool> is_there_{true};
};

// In the new process, which keeps nothing else open: writes the bytes to a line when no beat has come for so long,
// again every 50 ms until one comes. Once when the process that beats needs it no longer, and for 0.25 s when that was
// killed: what it sent last may take another way, and come later.
void write_in_silence(int beats, int line, const std::vector<std::uint8_t>& bytes, std::chrono::milliseconds silence);

// Calls stop, with the last note, when no beat has come for so long, and again every 50 ms until one comes. Returns
// when the process that beats has ended.
void watch_beats(int beats, std::chrono::milliseconds silence, const std::function<void(double note)>& stop);

}  // namespace cairn::live
