#include "framework/mission/orders/orders.hpp"

#include <utility>

namespace cairn {

Orders::Orders(OrderInbox* inbox, std::vector<RecordedOrder> played, const std::filesystem::path& out)
    : inbox_(inbox), played_(played.begin(), played.end()), out_(out), files_(out, false) {}

void Orders::collect() {
  if (inbox_ == nullptr) return;
  for (auto& sender : inbox_->take()) open_.push_back({sender->order, sender});
}

void Orders::begin_tick(double time_s) {
  if (++tick_ == 1) {
    std::error_code error;
    std::filesystem::remove(out_ / kOrdersFile, error);
  }
  time_s_ = time_s;
  for (; !played_.empty() && played_.front().tick <= tick_; played_.pop_front())
    open_.push_back({std::move(played_.front().order)});
  collect();
}

std::optional<Order> Orders::next() {
  if (handed_out_) answer({StepState::failure, "the step that takes orders has not answered"});
  if (open_.empty()) return std::nullopt;
  handed_out_ = std::move(open_.front());
  open_.erase(open_.begin());
  return handed_out_->order;
}

void Orders::answer(const Status& answer) {
  if (const std::optional<Open> open = std::exchange(handed_out_, std::nullopt)) close(*open, answer);
}

void Orders::close(const Open& open, const Status& answer) {
  const bool is_taken = answer.state != StepState::failure;
  if (is_taken)
    record(open.order);
  else
    sentences_.push_back("order " + open.order.text + " refused: " + answer.reason);
  if (open.sender) inbox_->answer(*open.sender, {is_taken, answer.reason, is_taken ? tick_ : 0, time_s_});
}

void Orders::record(const Order& order) {
  const Status written = files_.write({kOrdersFile, recorded_line(order, tick_, time_s_), true});
  if (written.state != StepState::success) sentences_.push_back("order " + order.text + ": " + written.reason);
}

std::vector<std::string> Orders::end_tick() {
  if (handed_out_) answer({StepState::failure, "the step that takes orders has not answered"});
  for (const Open& open : std::exchange(open_, {}))
    close(open, {StepState::failure, "no step await_orders is under way"});
  return std::exchange(sentences_, {});
}

std::vector<std::string> Orders::refuse_all(const std::string& why) {
  collect();
  for (const Open& open : std::exchange(open_, {})) close(open, {StepState::failure, why});
  return std::exchange(sentences_, {});
}

}  // namespace cairn
