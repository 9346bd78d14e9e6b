#include "plugins/behaviours/errands/await_orders.hpp"

#include <utility>

#include "plugins/behaviours/errands/go_to.hpp"
#include "plugins/behaviours/errands/name_landmark.hpp"
#include "plugins/behaviours/errands/return_home.hpp"
#include "plugins/behaviours/exploring/explore.hpp"
#include "plugins/behaviours/following/waiting_while_stopped.hpp"

namespace cairn::behaviours {
namespace {

// The step with the order's settings. Throws ConfigError.
template <class Step, class Config, class... Seed>
std::unique_ptr<Step> step_of(const Order& order, Seed... seed) {
  return std::make_unique<Step>(load_config<Config>(order.settings, order.kind), seed...);
}

struct Begun {
  std::unique_ptr<Behaviour> step;
  std::string refusal;
};

// Of a step that goes to a place: refused when the map does not hold it.
template <class Step>
Begun to_known_place(std::unique_ptr<Step> step, const WorldView& world, NamedPlaces& places) {
  std::string unknown = step->unknown_place(world, places);
  return {std::move(step), std::move(unknown)};
}

Begun begun(const Order& order, std::uint64_t seed, const WorldView& world, NamedPlaces& places) {
  if (order.kind == "goto") {
    auto step = step_of<GoTo, GoToConfig>(order, seed);
    step->move_with_map(world);
    return to_known_place(std::move(step), world, places);
  }
  if (order.kind == "return_home")
    return to_known_place(step_of<ReturnHome, ReturnHomeConfig>(order, seed), world, places);
  if (order.kind == "explore") return {step_of<Explore, ExploreConfig>(order), ""};
  return {nullptr, "await_orders does not know the order " + in_quotes(order.kind)};
}

}  // namespace

void AwaitOrdersConfig::describe(Fields<AwaitOrdersConfig>& fields) {
  fields.number("idle_at_most_s", &AwaitOrdersConfig::idle_at_most_s, {0.0, 1e6}, "s",
                "ends, with success, when it has waited so long for an order; without it, only `finish` ends it");
  fields.shorthand("idle_at_most_s");
}

void AwaitOrders::halt() {
  under_way_.reset();
  order_.clear();
  idle_since_s_.reset();
  is_finished_ = false;
}

Status AwaitOrders::tick(const WorldView& world, BehaviourContext& context) {
  while (const std::optional<Order> order = context.next_order()) {
    if (is_finished_)
      context.answer_order({StepState::failure, "the step that takes orders has been finished"});
    else
      context.answer_order(take(*order, world, context));
  }
  if (is_finished_) return {StepState::success, "finished by order"};
  if (under_way_) return carry_on(world, context);
  if (!idle_since_s_) idle_since_s_ = world.time_s;
  if (config_.idle_at_most_s && world.time_s - *idle_since_s_ >= *config_.idle_at_most_s)
    return {StepState::success, "no order has come any more"};
  return {StepState::running, "waiting for orders"};
}

Status AwaitOrders::take(const Order& order, const WorldView& world, BehaviourContext& context) {
  try {
    if (order.kind == "stop") return stop();
    if (order.kind == "finish") {
      (void)stop();
      is_finished_ = true;
      return {StepState::success, "finished"};
    }
    if (order.kind == "name") return step_of<NameLandmark, NameConfig>(order)->tick(world, context);
    return begin(order, world, context);
  } catch (const ConfigError& error) {
    return {StepState::failure, error.what()};
  }
}

Status AwaitOrders::begin(const Order& order, const WorldView& world, BehaviourContext& context) {
  Begun next = begun(order, seed_, world, context);
  if (!next.refusal.empty()) return {StepState::failure, std::move(next.refusal)};
  const std::string before = under_way_ ? " in place of " + order_ : "";
  under_way_ = std::make_unique<WaitingWhileStopped>(std::move(next.step));
  order_ = order.text;
  idle_since_s_.reset();
  context.report("order " + order_ + " taken" + before);
  return {StepState::success, "under way" + before};
}

Status AwaitOrders::stop() {
  const bool had_one = std::exchange(under_way_, nullptr) != nullptr;
  return {StepState::success, had_one ? "stopped " + std::exchange(order_, "") : "nothing was under way"};
}

Status AwaitOrders::carry_on(const WorldView& world, BehaviourContext& context) {
  const Status status = under_way_->tick(world, context);
  if (status.state == StepState::running)
    return {StepState::running, "order " + order_ + ": " + status.reason, status.left_s};
  context.report("order " + order_ + (status.state == StepState::success ? " done: " : " failed: ") + status.reason);
  (void)stop();
  return {StepState::running, "waiting for orders"};
}

}  // namespace cairn::behaviours
