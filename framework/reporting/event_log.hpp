// Sentences in the order of time, of which the first and the last are kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace cairn {

class EventLog {
 public:
  explicit EventLog(std::size_t max_events) : max_(max_events) {}

  void add(std::string sentence);
  // What is left out lies between the first and the last half of max_events.
  [[nodiscard]] std::vector<std::string> sentences() const;
  [[nodiscard]] std::int64_t left_out() const { return left_out_; }

 private:
  std::size_t max_;
  std::vector<std::string> first_;
  std::deque<std::string> last_;
  std::int64_t left_out_ = 0;
};

}  // namespace cairn
