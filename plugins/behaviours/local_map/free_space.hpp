// Where the robot can go from where it stands, on the map as it is now.
//
// A cell can be crossed when it is known free and its distance to every occupied cell is at least the
// robot's radius plus the clearance. Paths prefer more room than that. Where the robot has stood is
// free, whatever its sonars (which never look under it) say.
// A robot that stands nearer to something than the clearance first takes the shortest escape path.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "framework/config/fields.hpp"
#include "maps/grid/distance_field.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/grid/travel_field.hpp"
#include "plugins/behaviours/local_map/cell_layer.hpp"

namespace cairn::behaviours {

// Somewhere the robot was blocked: paths avoid it where they can.
struct TroubleSpot {
  Point at_m{0.0, 0.0};
  double until_s = 0.0;
};

struct FreeSpaceSettings {
  double preferred_room_m = 0.25;
  double tight_cost = 1.5;
  double avoided_cost = 20.0;
  double avoided_radius_m = 0.3;
  double longest_escape_m = 0.8;
  int longest_shortcut_cells = 60;
  static void describe(Fields<FreeSpaceSettings>& fields);
};

struct RobotSpace {
  Point position{0.0, 0.0};
  double radius_m = 0.22;
  double clearance_m = 0.1;  // kept beyond the radius
  FreeSpaceSettings settings{};
};

class FreeSpace {
 public:
  // trace: where the robot has been so far.
  FreeSpace(const OccupancyGrid& grid, const RobotSpace& robot, const std::vector<Pose2>& trace,
            const std::vector<TroubleSpot>& troubles = {});

  [[nodiscard]] CellBox box() const { return states_.box(); }
  [[nodiscard]] double cell_m() const { return field_.cell_m(); }
  [[nodiscard]] Cell cell_at(const Point& p_map) const { return field_.cell_at(p_map); }
  [[nodiscard]] Point centre_of(Cell cell) const { return field_.centre_of(cell); }
  [[nodiscard]] CellState state(Cell cell) const { return states_.at(cell); }
  // To the nearest occupied cell, between centres.
  [[nodiscard]] double distance_m(Cell cell) const { return field_.distance_m(cell); }
  [[nodiscard]] double min_distance_m() const { return min_m_; }
  [[nodiscard]] double radius_m() const { return robot_.radius_m; }

  [[nodiscard]] bool reaches(Cell cell) const;
  // Cost of the path: its length, with metres that cost more where there is little room; +inf when out of reach.
  [[nodiscard]] double cost_m(Cell cell) const;
  // Straightened; from the robot's position to the cell's centre. Empty when out of reach.
  [[nodiscard]] std::vector<Point> path_to(Cell cell) const;
  // From the robot to the first cell with enough room: only the robot when it stands in one, or when
  // there is none near.
  [[nodiscard]] const std::vector<Point>& escape_path() const { return escape_path_; }
  // Known free and clear all along.
  [[nodiscard]] bool line_is_open(const Point& from, const Point& to) const;
  // Nothing occupied between the point and the cell (the cell itself and what touches it aside).
  [[nodiscard]] bool sees(const Point& from, Cell cell) const;

 private:
  [[nodiscard]] static CellLayer<CellState> known_states(const OccupancyGrid& grid, const DistanceField& field,
                                                         double radius_m, const std::vector<Pose2>& trace);
  [[nodiscard]] CellLayer<float> weights(const std::vector<TroubleSpot>& troubles) const;
  [[nodiscard]] std::vector<Point> find_escape_path() const;
  [[nodiscard]] TravelField travel_from_escape() const;
  [[nodiscard]] const TravelField& travel() const;
  [[nodiscard]] double line_cost(const Point& from, const Point& to) const;
  [[nodiscard]] std::vector<Point> straightened(const std::vector<Cell>& cells) const;

  RobotSpace robot_;
  double min_m_;
  DistanceField field_;
  CellLayer<CellState> states_;
  CellLayer<float> weights_;
  std::vector<Point> escape_path_;
  // Made when it is asked for first: what only looks at room and states does without. Shared by copies.
  std::shared_ptr<std::optional<TravelField>> travel_ = std::make_shared<std::optional<TravelField>>();
};

// True when an occupied cell's centre lies within radius_m of the next ahead_m of a path. space gives the
// lattice only.
[[nodiscard]] bool path_is_blocked(const OccupancyGrid& space, const std::function<bool(Cell)>& is_occupied,
                                   const std::vector<Point>& path, double along_m, double ahead_m, double radius_m);
// The same with what the grid says.
[[nodiscard]] bool path_is_blocked(const OccupancyGrid& grid, const std::vector<Point>& path, double along_m,
                                   double ahead_m, double radius_m);

}  // namespace cairn::behaviours
