#include "framework/reporting/event_log.hpp"

namespace cairn {

void EventLog::add(std::string sentence) {
  const std::size_t first = max_ - max_ / 2;
  if (first_.size() < first) {
    first_.push_back(std::move(sentence));
    return;
  }
  last_.push_back(std::move(sentence));
  if (last_.size() <= max_ - first) return;
  last_.pop_front();
  ++left_out_;
}

std::vector<std::string> EventLog::sentences() const {
  std::vector<std::string> all = first_;
  all.insert(all.end(), last_.begin(), last_.end());
  return all;
}

}  // namespace cairn
