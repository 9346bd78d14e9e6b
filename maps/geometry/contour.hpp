// The outline of an object in its own frame: a circle, or one or several simple polygons apart from each
// other (the posts of a door frame, the legs of a bench).
//
// The frame's origin is the object's centre (circle centre; centroid of the polygons' area), so a
// landmark's position is the same point whatever its orientation.
#pragma once

#include <string>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

struct Contour {
  double circle_diameter_m = 0.0;  // > 0: a circle, and there is no polygon
  // Otherwise: at least one, each of at least 3 corners, anticlockwise, not repeated at the end.
  std::vector<std::vector<Point>> polygons_m;

  [[nodiscard]] static Contour circle(double diameter_m);
  // Centres the polygon on its centroid and makes it anticlockwise. Throws std::invalid_argument
  // with what is wrong when it has fewer than 3 corners, no area, crosses itself or is not finite.
  [[nodiscard]] static Contour polygon(std::vector<Point> corners_m);
  // The same as polygon(), but keeps the corners' frame instead of centring it (obstacles, rooms).
  [[nodiscard]] static Contour polygon_in_place(std::vector<Point> corners_m);
  // The same for several polygons. Throws too when there is none, or when one meets or holds another.
  [[nodiscard]] static Contour parts(std::vector<std::vector<Point>> polygons_m);
  [[nodiscard]] static Contour parts_in_place(std::vector<std::vector<Point>> polygons_m);

  [[nodiscard]] bool is_circle() const { return circle_diameter_m > 0.0; }
  // Diameters of the largest circle about the origin inside, and of the smallest one outside.
  [[nodiscard]] double inner_diameter_m() const;
  [[nodiscard]] double outer_diameter_m() const;
  // Of the area; the origin unless made in place.
  [[nodiscard]] Point centroid_m() const;
  // The outlines as polygons, a circle as one of so many corners.
  [[nodiscard]] std::vector<std::vector<Point>> outlines_m(int circle_corners) const;
  [[nodiscard]] Contour scaled(double ratio) const;  // about the origin; ratio > 0
  // Distance of a point to the nearest outline, negative inside.
  [[nodiscard]] double signed_distance(const Point& p) const;
  bool operator==(const Contour&) const = default;
};

// A landmark category as its template file describes it.
struct LandmarkShape {
  std::string category;
  Contour contour;
};

}  // namespace cairn
