// Goes back to where the mission began, or to a landmark that is its home.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/driving/route_driver.hpp"

namespace cairn::behaviours {

struct ReturnHomeConfig : RouteSettings {
  ConfigValue to;  // text: a landmark's id or name
  double at_most_s = 900.0;
  static void describe(Fields<ReturnHomeConfig>& fields);
};

class ReturnHome : public Behaviour {
 public:
  ReturnHome(const ReturnHomeConfig& config, std::uint64_t seed);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;
  // Why its home is no place on this map; empty: it is one.
  [[nodiscard]] std::string unknown_place(const WorldView& world, NamedPlaces& places) const;

 private:
  ReturnHomeConfig config_;
  std::uint64_t seed_;
  std::string to_;  // empty: where the mission began
  RouteDriver driver_;
  std::optional<double> begun_s_;
  std::optional<Place> goal_;
};

}  // namespace cairn::behaviours
