#include "framework/mission/orders/order_inbox.hpp"

#include <utility>

namespace cairn {
namespace {

constexpr std::size_t kMaxWaiting = 64;
constexpr const char* kEnded = "the mission has ended";

}  // namespace

OrderAnswer OrderInbox::give(Order order, std::chrono::milliseconds at_most) {
  std::unique_lock lock(mutex_);
  if (is_closed_) return {false, kEnded};
  if (waiting_.size() >= kMaxWaiting) return {false, "too many orders wait already"};
  const auto mine = waiting_.emplace_back(std::make_shared<Waiting>(Waiting{std::move(order)}));
  has_new_.store(true, std::memory_order_release);
  changed_.wait_for(lock, at_most, [&] { return mine->is_answered; });
  if (!mine->is_answered && !mine->is_looked_at) {
    std::erase(waiting_, mine);
    return {false, "the mission is busy and has not looked at the order in time; it is withdrawn"};
  }
  changed_.wait(lock, [&] { return mine->is_answered; });  // the tick that looks at it answers, or the mission ends
  return mine->answer;
}

std::vector<std::shared_ptr<OrderInbox::Waiting>> OrderInbox::take() {
  std::vector<std::shared_ptr<Waiting>> taken;
  if (!has_new_.load(std::memory_order_acquire)) return taken;
  const std::scoped_lock lock(mutex_);
  has_new_ = false;
  for (const auto& waiting : waiting_)
    if (!std::exchange(waiting->is_looked_at, true)) taken.push_back(waiting);
  return taken;
}

void OrderInbox::answer(Waiting& waiting, OrderAnswer answer) {
  const std::scoped_lock lock(mutex_);
  if (std::exchange(waiting.is_answered, true)) return;
  waiting.answer = std::move(answer);
  std::erase_if(waiting_, [&](const auto& other) { return other.get() == &waiting; });
  changed_.notify_all();
}

void OrderInbox::close() {
  const std::scoped_lock lock(mutex_);
  is_closed_ = true;
  for (const auto& waiting : std::exchange(waiting_, {})) {
    waiting->is_answered = true;
    waiting->answer = {false, kEnded};
  }
  changed_.notify_all();
}

}  // namespace cairn
