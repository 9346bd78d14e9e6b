// A drive that may also implement this: one that can say nothing at all, so that people see whether the base stops its
// wheels by itself (`cairn doctor live --wiggle`).
#pragma once

namespace cairn {

class CommandSilence {
 public:
  virtual ~CommandSilence() = default;
  // From now on, and for so long, nothing is sent to the wheels, not even that they are to stand; then they are ordered
  // to stand. stop() ends it at once.
  virtual void be_silent(double for_s) = 0;
};

}  // namespace cairn
