// The outline of an object in its own frame: a circle or a simple polygon.
//
// The frame's origin is the object's centre (circle centre; centroid of the polygon's area), so a
// landmark's position is the same point whatever its orientation.
#pragma once

#include <string>
#include <vector>

#include "maps/pose.hpp"

namespace cairn {

struct Contour {
  double circle_diameter_m = 0.0;  // > 0: a circle, and polygon_m is empty
  std::vector<Point> polygon_m;    // otherwise: at least 3 corners, anticlockwise, not repeated at the end

  [[nodiscard]] static Contour circle(double diameter_m);
  // Centres the polygon on its centroid and makes it anticlockwise. Throws std::invalid_argument
  // with what is wrong when it has fewer than 3 corners, no area, crosses itself or is not finite.
  [[nodiscard]] static Contour polygon(std::vector<Point> corners_m);
  // The same as polygon(), but keeps the corners' frame instead of centring it (obstacles, rooms).
  [[nodiscard]] static Contour polygon_in_place(std::vector<Point> corners_m);

  [[nodiscard]] bool is_circle() const { return circle_diameter_m > 0.0; }
  // Diameters of the largest circle about the origin inside, and of the smallest one outside.
  [[nodiscard]] double inner_diameter_m() const;
  [[nodiscard]] double outer_diameter_m() const;
  // Distance of a point to the outline, negative inside.
  [[nodiscard]] double signed_distance(const Point& p) const;
  bool operator==(const Contour&) const = default;
};

// A landmark category as its template file describes it.
struct LandmarkShape {
  std::string category;
  Contour contour;
};

}  // namespace cairn
