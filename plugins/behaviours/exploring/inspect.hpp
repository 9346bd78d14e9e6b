// Inspects a landmark: goes there and circles it until its degree does not rise any more.
//
// The laps are those of exploring (look_closer.hpp): what cannot be stood in is left out. Success says the degree
// before and after; failure when it cannot be circled at all.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/driving/followed_path.hpp"
#include "plugins/behaviours/driving/progress_checker.hpp"
#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/exploring/look_closer.hpp"

namespace cairn::behaviours {

struct InspectOrbitSettings {
  double near_m = 1.5;
  double around_m = 3.0;
  double clearance_m = 0.08;
  double further_m = 0.3;
  double largest_object_m = 1.5;
  double is_landmark_m = 0.4;
  int usual_outline_cells = 3;
  double choose_every_s = 2.5;
  double trace_apart_m = 0.1;
  int min_covered_sectors = 4;
  double arrived_m = 0.06;
  double avoid_ahead_m = 0.4;
  double back_up_mps = 0.1;
  double back_up_s = 1.5;
  double behind_m = 0.2;
  ObjectSettings object;
  static void describe(Fields<InspectOrbitSettings>& fields);
};

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
  ControlResult follow_path(BehaviourContext& context);
  Status back_off(const WorldView& world, BehaviourContext& context);
  Status end_orbit(const Landmark& landmark, BehaviourContext& context);
  Status finish(const Landmark& landmark, const std::string& why) const;
  void remember(const WorldView& world);
  // False when nothing of the lap is left.
  [[nodiscard]] bool choose_path(const WorldView& world, const Landmark& landmark);

  InspectConfig config_;
  std::uint64_t seed_;
  std::string name_;
  RouteDriver driver_;
  ProgressChecker progress_;
  Mode mode_ = Mode::drive;
  std::optional<double> begun_s_;
  LandmarkId landmark_ = 0;
  double degree_before_ = 0.0;
  double degree_at_lap_ = 0.0;             // when the lap began
  int orbits_ = 0;                         // done
  int covered_ = 0;                        // sectors of this lap
  std::vector<Pose2> trace_;               // of this lap
  std::size_t orbit_begins_ = 0;           // in the trace
  std::optional<NearEchoes> near_echoes_;  // from the first tick on
  std::vector<Point> avoid_;
  FollowedPath path_;
  double chosen_s_ = -1e9;
  double backing_since_s_ = 0.0;
  Twist wanted_;
};

}  // namespace cairn::behaviours
