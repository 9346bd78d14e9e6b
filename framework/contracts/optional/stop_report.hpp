// A drive that may also implement this: one whose stop() cannot reach the wheels itself from a signal handler, so that
// another thread of the process sends it.
#pragma once

namespace cairn {

class StopReport {
 public:
  virtual ~StopReport() = default;
  // Whether the last stop() has been sent to the wheels. From any thread and from a signal handler: no lock, no
  // allocation.
  [[nodiscard]] virtual bool is_stop_sent() const noexcept = 0;
};

}  // namespace cairn
