// Where on OG1 a disc fits and along which straight segments it may move.
//
// Answers are exact: a disc fits where it touches no blocked cell (swept_disc.hpp). The distance field
// answers nearly all questions at once; only what is too close to decide is checked cell by cell.
// Immutable and thread-safe. Building it costs O(cells).
#pragma once

#include <memory>

#include "maps/grid/distance_field.hpp"
#include "maps/grid/swept_disc.hpp"
#include "maps/grid/travel_field.hpp"

namespace cairn {

class DiscSpace {
 public:
  DiscSpace(const OccupancyGrid& grid, const GroundRules& rules);
  // Of a grid that differs from that of `before`, with its rules, within `changed` only: finds anew what that concerns.
  DiscSpace(const DiscSpace& before, const OccupancyGrid& grid, const CellBox& changed);

  [[nodiscard]] const DistanceField& field() const { return field_; }
  [[nodiscard]] const GroundRules& rules() const { return rules_; }
  [[nodiscard]] double cell_m() const { return lattice_.cell_m; }
  // Inside the box of the distance field; the centre of a disc never leaves it.
  [[nodiscard]] bool contains(const Point& p_map) const;
  [[nodiscard]] bool is_blocked(Cell cell) const {
    return field_.box().contains(cell) ? field_.is_blocked(cell) : rules_.unknown == UnknownPolicy::avoid;
  }

  [[nodiscard]] bool fits(const Point& p_map, double radius_m) const { return fits_along(p_map, p_map, radius_m); }
  [[nodiscard]] bool fits_along(const Point& from, const Point& to, double radius_m) const;
  // The end of the longest first part of the segment along which the disc fits, as a share of it.
  [[nodiscard]] double share_that_fits(const Point& from, const Point& to, double radius_m) const;
  // Distance from a segment inside the map to the nearest blocked square.
  [[nodiscard]] double distance_m(const Point& from, const Point& to) const;

  // Whether a point could get from one to the other, over cells that share a side. False inside what is blocked.
  [[nodiscard]] bool joined(const Point& a, const Point& b) const;

  // The same ground on a lattice `parts` times as fine: the same answers, with narrower doubt below.
  [[nodiscard]] DiscSpace refined(int parts) const;

  // Travel from a point over every cell in which such a disc might fit: a cell that it does not reach
  // cannot be reached. What it reaches may still be too narrow by less than two cells.
  [[nodiscard]] TravelField travel_at_most(const Point& from, double radius_m) const;

 private:
  DiscSpace(const DiscSpace& coarse, int parts);

  // What the distance to the nearest blocked square is at least and at most, for a point of the box.
  struct Bounds {
    double min_m;
    double max_m;
  };
  [[nodiscard]] Bounds bounds_at(const Point& p_map) const;
  [[nodiscard]] bool nothing_blocks() const;

  struct Parts;

  GroundRules rules_;
  DistanceField field_;
  Lattice lattice_;
  std::shared_ptr<Parts> parts_;  // made when first asked for
};

}  // namespace cairn
