// Random homes for experiments: rooms behind doors, with or without a corridor, furnished.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "maps/geometry/contour.hpp"

namespace cairn {

// An experiment's `homes`.
struct HomesConfig {
  int min_rooms = 3;
  int max_rooms = 6;
  double min_area_m2 = 40.0;
  double max_area_m2 = 120.0;
  double min_door_m = 0.75;
  double max_door_m = 1.0;
  double corridor_ratio = 0.5;
  double corner_ratio = 0.3;
  double wall_m = 0.1;
  int max_furniture = 3;
  double gap_m = 0.7;
  int tags = 0;
  double tag_size_m = 0.16;
  // How a run is judged.
  double fast_mps = 0.05;
  double beyond_door_m = 0.0;
  double tag_tolerance_m = 0.5;
  static void describe(Fields<HomesConfig>& fields);
};

struct HomeRoom {
  Point min_m{0.0, 0.0};  // between its walls
  Point max_m{0.0, 0.0};

  [[nodiscard]] bool contains(const Point& p_m, double inside_m = 0.0) const {
    return (p_m.array() >= min_m.array() + inside_m).all() && (p_m.array() <= max_m.array() - inside_m).all();
  }
};

struct HomeDoor {
  Point middle_m{0.0, 0.0};
  double width_m = 0.0;
  int rooms[2] = {0, 0};    // that it joins
  bool is_upright = false;  // its leaf along y

  [[nodiscard]] Point from_m() const { return middle_m - half_m(); }
  [[nodiscard]] Point to_m() const { return middle_m + half_m(); }
  [[nodiscard]] Point half_m() const { return is_upright ? Point(0.0, 0.5 * width_m) : Point(0.5 * width_m, 0.0); }
};

struct Home {
  std::vector<HomeRoom> rooms;  // a corridor is one of them
  std::vector<HomeDoor> doors;
  Point start_m{0.0, 0.0};
  double start_deg = 0.0;
  std::string world_yaml;
};

// The same home for the same seed. Every room is joined to every other through doors; each door has 0.9 m of room
// before it on both sides, furniture stands against a wall or free with gap_m around it. Some homes lack a corner: an
// L. Tags change nothing else of a home.
[[nodiscard]] Home random_home(const HomesConfig& config, std::uint64_t seed);

}  // namespace cairn
