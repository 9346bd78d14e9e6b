// The orders of a run, for the mission's thread: hands them to the behaviour that asks for them, records what it takes,
// and plays recorded ones again with the same ticks.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/behaviour.hpp"
#include "framework/mission/loop/text_files.hpp"
#include "framework/mission/orders/order_inbox.hpp"
#include "framework/mission/orders/order_text.hpp"

namespace cairn {

class Orders {
 public:
  // inbox: may be null; must outlive this. out: the output folder, in which the first tick removes the record of an
  // earlier run.
  Orders(OrderInbox* inbox, std::vector<RecordedOrder> played, const std::filesystem::path& out);

  // One that nobody waits for the answer of; of the next tick.
  void give(Order order) { open_.push_back({std::move(order)}); }
  // A tick of the steps: what has come by now, and what is recorded for it, is handed out until the tick ends.
  void begin_tick(double time_s);
  [[nodiscard]] std::optional<Order> next();
  // Of the one handed out last.
  void answer(const Status& answer);
  // What nobody has asked for is refused. Sentences for people: what was refused, and what could not be recorded.
  [[nodiscard]] std::vector<std::string> end_tick();
  // What has come meanwhile is refused for this reason. The same sentences.
  [[nodiscard]] std::vector<std::string> refuse_all(const std::string& why);

 private:
  struct Open {
    Order order;
    std::shared_ptr<OrderInbox::Waiting> sender{};  // null: a recorded one
  };
  void collect();
  void close(const Open& open, const Status& answer);
  void record(const Order& order);

  OrderInbox* const inbox_;
  std::deque<RecordedOrder> played_;
  const std::filesystem::path out_;
  TextFiles files_;
  std::int64_t tick_ = 0;
  double time_s_ = 0.0;
  std::vector<Open> open_;  // no deque: an empty one allocates, each tick
  std::optional<Open> handed_out_;
  std::vector<std::string> sentences_;
};

}  // namespace cairn
