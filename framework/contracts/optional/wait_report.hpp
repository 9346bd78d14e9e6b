// A sensor that may also implement this: one that waits for a robot which may not be there.
#pragma once

#include <string>

namespace cairn {

class WaitReport {
 public:
  virtual ~WaitReport() = default;
  // For people, when next() has waited so long that they wonder: what it waits for, for how long at most, and why it is
  // not there if that is known. Empty: it does not wait. From any thread.
  [[nodiscard]] virtual std::string waits_for() const = 0;
};

}  // namespace cairn
