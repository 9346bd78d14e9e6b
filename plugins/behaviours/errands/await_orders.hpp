// Waits for orders that people give while the mission runs, and carries each out by the step of that name.
//
// A new order takes the place of the one under way; `name` is carried out at once beside it. An order that fails ends
// itself, not the step.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"

namespace cairn::behaviours {

struct AwaitOrdersConfig {
  std::optional<double> idle_at_most_s;
  static void describe(Fields<AwaitOrdersConfig>& fields);
};

class AwaitOrders : public Behaviour {
 public:
  AwaitOrders(const AwaitOrdersConfig& config, std::uint64_t seed) : config_(config), seed_(seed) {}
  // Success with the order `finish`, and when nothing was ordered or done for idle_at_most_s. Orders with wrong
  // settings, and places that the map does not hold, are refused.
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;

 private:
  [[nodiscard]] Status take(const Order& order, const WorldView& world, BehaviourContext& context);
  [[nodiscard]] Status begin(const Order& order, const WorldView& world, BehaviourContext& context);
  [[nodiscard]] Status stop();
  [[nodiscard]] Status carry_on(const WorldView& world, BehaviourContext& context);

  const AwaitOrdersConfig config_;
  const std::uint64_t seed_;
  std::unique_ptr<Behaviour> under_way_;  // null: it waits
  std::string order_;                     // under way, for people
  std::optional<double> idle_since_s_;
  bool is_finished_ = false;
};

}  // namespace cairn::behaviours
