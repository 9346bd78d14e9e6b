// Inspects a landmark: goes there and circles it until its degree does not rise any more.
//
// The orbits are those of exploring (look_closer.hpp): what cannot be stood in is left out. Success says the degree
// before and after; failure when it cannot be circled at all.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/exploring/landmark_orbit.hpp"
#include "plugins/behaviours/following/direct_follower.hpp"
#include "plugins/behaviours/places/map_watch.hpp"

namespace cairn::behaviours {

struct InspectConfig : RouteSettings {
  ConfigValue landmark;  // text
  double distance_m = 0.6;
  int rounds_at_most = 3;
  double gain = 0.01;
  double orbit_speed_mps = 0.1;
  double at_most_s = 900.0;
  InspectOrbitSettings orbit;
  static void describe(Fields<InspectConfig>& fields);
};

class Inspect : public Behaviour {
 public:
  Inspect(const InspectConfig& config, std::uint64_t seed);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;

 private:
  enum class Mode { drive, orbit, back_off };

  Status begin(const WorldView& world, BehaviourContext& context);
  Status drive(const WorldView& world, BehaviourContext& context, const Landmark& landmark);
  Status orbit(const WorldView& world, BehaviourContext& context, const Landmark& landmark);
  Status back_off(const WorldView& world, BehaviourContext& context);
  Status end_orbit(const Landmark& landmark, BehaviourContext& context);
  Status finish(const Landmark& landmark, const std::string& why) const;
  // False when nothing of the orbit is left.
  [[nodiscard]] bool choose_path(const WorldView& world, const Landmark& landmark);

  InspectConfig config_;
  std::uint64_t seed_;
  std::string name_;
  RouteDriver driver_;
  DirectFollower follower_;  // on the orbit
  LandmarkOrbit landmark_orbit_;
  Mode mode_ = Mode::drive;
  std::optional<double> begun_s_;
  LandmarkId landmark_ = 0;
  double degree_before_ = 0.0;
  double degree_at_begin_ = 0.0;  // when the orbit began
  int orbits_ = 0;                // done
  double chosen_s_ = -1e9;
  double backing_since_s_ = 0.0;
  MapWatch map_watch_;
};

}  // namespace cairn::behaviours
