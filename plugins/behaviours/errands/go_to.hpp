// Goes to a landmark or a place by the mission's planner, and faces it.
//
// The route driver does the driving, and says why when it gives up.
#pragma once

#include <optional>
#include <string>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/places/map_watch.hpp"
#include "plugins/behaviours/places/place_name.hpp"

namespace cairn::behaviours {

struct GoToConfig : RouteSettings {
  ConfigValue landmark;  // `L3`, a name, `nearest CATEGORY`, or [x, y]
  std::optional<Point> at_m;
  std::optional<double> angle_rad;
  std::string input;  // a place that an earlier step gives
  double at_most_s = 900.0;

  static void describe(Fields<GoToConfig>& fields);
};

class GoTo : public Behaviour {
 public:
  // Throws ConfigError unless exactly one of landmark, at_m and input is given.
  GoTo(const GoToConfig& config, std::uint64_t seed);

  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;
  // Its point is a place that somebody has seen on this map: when the map is exchanged, also before the first tick, it
  // moves along. One that a mission's file gives does not.
  void move_with_map(const WorldView& world);
  // Why the place that it goes to is none on this map; empty: it is one.
  [[nodiscard]] std::string unknown_place(const WorldView& world, NamedPlaces& places) const {
    return find_goal(world, places).unknown;
  }

 private:
  void begin_in_new_map(const MapMove& move);
  Status drive_there(const WorldView& world, BehaviourContext& context);
  Status face(const WorldView& world, MotionRequests& context);
  [[nodiscard]] FoundPlace find_goal(const WorldView& world, NamedPlaces& context) const;
  [[nodiscard]] std::string destination(const WorldView& world) const;

  GoToConfig config_;
  std::string landmark_name_;
  std::uint64_t seed_;
  RouteDriver driver_;
  std::optional<double> begun_s_;
  std::optional<Place> goal_;             // from the first tick on
  std::optional<double> facing_since_s_;  // there, turning to the landmark
  bool moves_with_map_ = false;
  MapWatch map_watch_;
};

}  // namespace cairn::behaviours
