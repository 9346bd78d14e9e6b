// Gives a landmark or a cluster of them a name. From then on the name is a place for steps, for `cairn plan` and in the
// saved map.
#pragma once

#include <optional>
#include <string>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/places/place_name.hpp"

namespace cairn::behaviours {

struct NameConfig {
  ConfigValue as;        // text
  ConfigValue landmark;  // text
  std::string input;     // the name of the place that an earlier step gives
  std::optional<Point> near_m;
  double within_m = 1.0;
  static void describe(Fields<NameConfig>& fields);
};

class NameLandmark : public Behaviour {
 public:
  // Throws ConfigError on a name that is also a place of another kind, on a landmark that is none, and when both
  // `landmark` and `input` are given.
  explicit NameLandmark(const NameConfig& config);
  // A cluster is named as a whole, unless near_m chooses one of its landmarks. Of several landmarks that are meant:
  // with near_m the nearest to that point, else of `input` the one found last, of `nearest CATEGORY` the one with the
  // cheapest path. With neither of them: the landmark found last.
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override {}

 private:
  [[nodiscard]] FoundPlace meant(const WorldView& world, NamedPlaces& places) const;
  [[nodiscard]] ChosenLandmark chosen(const WorldView& world, BehaviourContext& context) const;

  NameConfig config_;
  std::string as_;
  std::string landmark_;  // empty: none is named
};

}  // namespace cairn::behaviours
