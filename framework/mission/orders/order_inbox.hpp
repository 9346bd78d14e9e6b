// Orders on their way from other threads to the mission's, and the answers on their way back.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "framework/contracts/order.hpp"

namespace cairn {

struct OrderAnswer {
  bool is_taken = false;
  std::string reason{};   // what is done, or why it is refused
  std::int64_t tick = 0;  // with which it was taken
  double time_s = 0.0;    // of the mission's clock
};

class OrderInbox {
 public:
  // From any thread: the mission's answer. An order that the mission has not begun to look at by then is withdrawn, and
  // refused.
  [[nodiscard]] OrderAnswer give(Order order, std::chrono::milliseconds at_most);

  // For the mission's thread: what has come since. Each one must get its answer with the same tick. Cheap when nothing
  // has come.
  struct Waiting {
    Order order;
    bool is_looked_at = false;
    bool is_answered = false;
    OrderAnswer answer{};
  };
  [[nodiscard]] std::vector<std::shared_ptr<Waiting>> take();
  void answer(Waiting& waiting, OrderAnswer answer);

  // The mission has ended: all that wait, and all that come later, are refused.
  void close();

 private:
  std::atomic<bool> has_new_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Waiting>> waiting_;  // not answered yet
  bool is_closed_ = false;
};

}  // namespace cairn
