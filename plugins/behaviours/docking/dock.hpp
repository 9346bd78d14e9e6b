// Docks beside a landmark: plans to an approach pose on the wanted side, then approaches straight and slowly by the
// latest echoes, and stops at a distance between the robot's footprint and the landmark's outline.
//
// Where no echo of the landmark comes back, its outline is taken from the map. Honest failures: the side is blocked,
// the approach pose cannot be reached, something stands between, the robot is blocked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/docking/axis_echoes.hpp"
#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/following/progress_checker.hpp"
#include "plugins/behaviours/places/map_watch.hpp"

namespace cairn::behaviours {

struct OutlineSettings {
  double farthest_m = 1.2;
  double behind_m = 0.2;
  double usual_m = 0.2;
  static void describe(Fields<OutlineSettings>& fields);
};

struct ApproachSettings : ApproachEchoSettings {
  double beside_m = 0.3;
  int max_again = 3;
  double settle_s = 1.0;
  double min_mps = 0.02;
  double gain_per_s = 0.8;
  double turn_first_rad = radians(12.0);
  double max_correction_rad = radians(20.0);
  double correction_rad_per_m = 2.5;
  double correct_until_m = 0.1;
  double faced_rad = radians(3.0);
  double turn_gain_per_s = 1.5;
  double max_turn_radps = radians(40.0);
  double final_turn_radps = radians(45.0);
  double room_to_turn_m = 0.02;
  double nearest_m = 0.02;
  double arrived_ratio = 0.5;
  static void describe(Fields<ApproachSettings>& fields);
};

struct DockConfig : RouteSettings {
  enum class Facing { landmark, away };

  ConfigValue landmark;  // text
  std::optional<double> side_rad;
  ConfigValue side;  // front, left, back or right
  double distance_m = 0.4;
  Facing facing = Facing::landmark;
  double dock_tolerance_m = 0.03;
  double approach_mps = 0.1;
  double at_most_s = 300.0;
  std::vector<double> run_ups_m{0.5, 0.35, 0.25, 0.15};  // from the approach pose to the dock
  OutlineSettings outline;
  ApproachSettings approach;
  static void describe(Fields<DockConfig>& fields);
};

// How far a landmark's outline is from its centre in a direction of the map, as the grid has it; none: nothing occupied
// within settings.farthest_m there.
[[nodiscard]] std::optional<double> outline_distance_m(const OccupancyGrid& grid, const Point& centre, double angle_rad,
                                                       const OutlineSettings& settings = {});

class Dock : public Behaviour {
 public:
  // Throws ConfigError on both or neither of side and side_deg, and a side that is none.
  Dock(const DockConfig& config, std::uint64_t seed);
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;

 private:
  enum class Mode { drive, approach, turn };

  [[nodiscard]] DockAxis axis(const Landmark& landmark) const;
  Status begin(const WorldView& world, BehaviourContext& context);
  [[nodiscard]] bool choose_approach_pose(const WorldView& world, const Landmark& landmark);
  void begin_in_new_map(const MapMove* move);
  Status drive(const WorldView& world, BehaviourContext& context);
  Status approach(const WorldView& world, BehaviourContext& context, const Landmark& landmark);
  Status go_again(const WorldView& world, const Landmark& landmark);
  Status turn(const WorldView& world, BehaviourContext& context, const Landmark& landmark);
  [[nodiscard]] double mapped_outline_m(const OccupancyGrid& grid, const DockAxis& axis) const;
  [[nodiscard]] Twist twist_towards(double left_m, double error_rad, const RobotModel& robot) const;
  [[nodiscard]] double wanted_m(const RobotModel& robot) const;
  [[nodiscard]] std::string where(const WorldView& world) const;

  DockConfig config_;
  std::uint64_t seed_;
  std::string name_;
  double side_rad_ = 0.0;
  RouteDriver driver_;
  ProgressChecker progress_;
  Mode mode_ = Mode::drive;
  std::optional<double> begun_s_;
  LandmarkId landmark_ = 0;
  // Of the side that was meant at first: a square's orientation may turn by a right angle when more of it is seen.
  double outward_rad_ = 0.0;
  int again_ = 0;
  Place approach_pose_;
  AxisEchoes echoes_;
  std::optional<double> still_since_s_;
  double gap_m_ = 0.0;  // as last estimated
  MapWatch map_watch_;
  Twist wanted_;
};

}  // namespace cairn::behaviours
