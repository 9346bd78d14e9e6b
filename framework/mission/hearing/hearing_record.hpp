// Which transducers have gone deaf in a mission, in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/mission/events.hpp"
#include "framework/safety/deaf_transducers.hpp"

namespace cairn {

// "transducer 3", "transducers 0 to 6", "transducers 0, 2 and 5". Numbers rise; there is one at least.
[[nodiscard]] std::string transducers_text(const std::vector<int>& sensors);
[[nodiscard]] std::string text_of(const WentDeaf& event);
[[nodiscard]] std::string text_of(const HearsAgain& event);

// What becomes of it from tick to tick.
class HearingRecord {
 public:
  // The events that the last drive() brings about.
  [[nodiscard]] std::vector<Event> update(const DeafTransducers& hearing, double time_s);
  // For people; empty: none has been deaf.
  [[nodiscard]] std::string summary() const;
  [[nodiscard]] bool is_deaf() const { return !deaf_.empty(); }

 private:
  std::vector<int> deaf_;  // now
  std::vector<int> ever_deaf_;
  double first_s_ = 0.0;
  double last_s_ = 0.0;  // when it heard again
  bool was_ring_silent_ = false;
};

}  // namespace cairn
