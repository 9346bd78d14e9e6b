// The path of an orbit round a landmark, chosen anew as the map grows: past what the robot has not looked at yet.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/world_view.hpp"
#include "plugins/behaviours/local_map/local_map.hpp"
#include "plugins/behaviours/lookouts/look_closer.hpp"

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

class LandmarkOrbit {
 public:
  // distance_m: from the landmark's edge to the robot's centre.
  LandmarkOrbit(const InspectOrbitSettings& settings, double distance_m, const LocalMapSettings& map)
      : settings_(settings), distance_m_(distance_m), map_(map) {}

  // Every tick.
  void see(const WorldView& world);
  // The map has been exchanged; null: all is to be looked at again.
  void begin_in_new_map(const MapMove* move);
  // A new orbit: all is to be looked at again.
  void begin();
  // Places of this orbit that the robot cannot get to, or sees nothing from.
  void avoid(const Point& at) { avoid_.push_back(at); }

  // Empty when nothing of the orbit is left, or nothing in reach.
  [[nodiscard]] std::vector<Point> path(const WorldView& world, const Point& centre);
  // Whether enough of it had been looked at when its path was chosen last.
  [[nodiscard]] bool is_covered() const { return covered_ >= settings_.min_covered_sectors; }

 private:
  InspectOrbitSettings settings_;
  double distance_m_;
  LocalMapSettings map_;
  std::optional<NearEchoes> near_echoes_;  // from the first tick on
  std::vector<Pose2> trace_;
  std::size_t begins_ = 0;  // in the trace
  std::vector<Point> avoid_;
  int covered_ = 0;  // sectors
};

}  // namespace cairn::behaviours
