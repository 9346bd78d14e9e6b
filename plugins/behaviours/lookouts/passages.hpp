// Passages: where what the robot can get to goes on, through a door or a gap, into what it has not been in.
//
// Unlike frontiers and openings, a passage need not be known free: unknown cells in it count as free. One that is drawn
// shut is suspected where echoes have come through: the width of a beam closes a doorway that is passed along its wall.
#pragma once

#include <optional>
#include <vector>

#include "plugins/behaviours/local_map/cell_layer.hpp"
#include "plugins/behaviours/local_map/free_space.hpp"
#include "plugins/behaviours/local_map/near_echoes.hpp"
#include "plugins/behaviours/lookouts/opening_echoes.hpp"

namespace cairn::behaviours {

struct PassageSettings {
  double min_radius_m = 0.08;
  double drive_radius_m = 0.1;
  double room_behind_m2 = 0.4;
  double min_depth_m = 0.5;
  double seen_through_m2 = 0.15;
  double missed_m2 = 1.0;
  double max_wall_m = 0.5;
  double look_from_m = 0.7;
  double look_again_from_m = 0.5;
  double look_at_least_from_m = 0.35;
  double beyond_m = 0.5;
  double same_m = 0.45;
  double narrow_cost = 10.0;
  double seen_bonus_m_per_m2 = 4.0;
  double max_seen_m2 = 3.0;
  double look_beside_m = 6.0;
  double beside_m = 2.0;
  int max_suspects = 8;
  int max_tries = 2;
  double dared_ratio = 0.5;
  int max_passes = 8;
  OpeningEchoSettings echoes;
  NearEchoSettings passed{
      .within_m = 4.0, .hit = 10, .passed = -40, .solid_at = 32000, .free_at = -120, .clamp_nat = 0.8};
  static void describe(Fields<PassageSettings>& fields);
};

struct Passage {
  Point at_m{0.0, 0.0};  // where it is narrowest
  double width_m = 0.0;  // there, between what is drawn occupied
  Cell lookout;          // straight before it, where the robot can get to
  Point beyond_m{0.0, 0.0};
  double behind_m2 = 0.0;  // of a suspected one: what echoes have shown behind it
};

// What the robot can get to from where it is or has ever been: known free cells with the space's clearance, joined to a
// place of the trace.
[[nodiscard]] CellLayer<char> reach_of(const FreeSpace& space, const std::vector<Pose2>& trace);

// How much room echoes have shown behind walls, all of it that is near to what is in reach.
[[nodiscard]] double seen_behind_walls_m2(const FreeSpace& space, const OccupancyGrid& grid,
                                          const CellLayer<char>& reach, const std::vector<Point>& without,
                                          const PassageSettings& settings = {});

struct PassageSearch {
  bool through_walls = false;  // suspected ones: drawn shut, but seen through
  std::vector<Point> without;  // none within same_m of these
};

// The one whose lookout is nearest to the robot by path, as the crow flies where there is none; narrow ones come later,
// suspected ones with much behind them earlier. None within same_m of what it is to do without. O(cells log cells).
[[nodiscard]] std::optional<Passage> nearest_passage(const FreeSpace& space, const OccupancyGrid& grid,
                                                     const CellLayer<char>& reach, const Point& robot,
                                                     const PassageSearch& search, const PassageSettings& settings = {});

}  // namespace cairn::behaviours
