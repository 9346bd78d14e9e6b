#include "plugins/odometry_compass/outline_echo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/geometry/segments.hpp"

namespace cairn::odometry_compass {
namespace {

constexpr double kRimRatio = 0.9;      // of the half-beam: beyond it an echo is a matter of loudness
constexpr double kMinIncidence = 0.5;  // cosine: rays that graze say little of where a face is
constexpr double kOnTop_m = 1e-3;

// The nearest point in the cone so far.
struct Nearest {
  Point from_m;
  Point axis;
  double half_beam_rad;
  double best_m = std::numeric_limits<double>::infinity();
  Point target_m{0.0, 0.0};
  bool at_rim = false;

  void consider(const Point& target) {
    const Point offset = target - from_m;
    const double range_m = offset.norm();
    if (range_m >= best_m) return;
    const double off_axis_rad = std::abs(std::atan2(cross(axis, offset), axis.dot(offset)));
    if (off_axis_rad > half_beam_rad * (1.0 + 1e-9)) return;
    best_m = range_m;
    target_m = target;
    at_rim = off_axis_rad > kRimRatio * half_beam_rad;
  }
};

void consider_face(const Point& a, const Point& b, Nearest& nearest) {
  const Point along = b - a;
  // Outlines run anticlockwise: outside is on the right.
  if (cross(along, nearest.from_m - a) >= 0.0) return;
  nearest.consider(nearest_on_segment(nearest.from_m, a, b));
  // Where the rims cross the face, so that a face which leaves the cone is known to be nearest there.
  for (const double side : {-1.0, 1.0}) {
    const double c = std::cos(nearest.half_beam_rad);
    const double s = side * std::sin(nearest.half_beam_rad);
    const Point rim(c * nearest.axis.x() - s * nearest.axis.y(), s * nearest.axis.x() + c * nearest.axis.y());
    const double turn = cross(rim, along);
    if (std::abs(turn) < 1e-12) continue;
    const double at = cross(rim, nearest.from_m - a) / turn;
    const Point meets = a + at * along;
    if (at >= 0.0 && at <= 1.0 && rim.dot(meets - nearest.from_m) > 0.0) nearest.consider(meets);
  }
}

std::optional<ExpectedEcho> cone_echo(const Contour& contour, const Pose2& T_contour_sensor, double half_beam_rad) {
  Nearest nearest{T_contour_sensor.position(), T_contour_sensor.direction(), half_beam_rad};
  if (contour.is_circle()) {
    nearest.consider(0.5 * contour.circle_diameter_m * nearest.from_m.normalized());
  } else {
    for (const auto& polygon : contour.polygons_m)
      for (std::size_t i = 0; i < polygon.size(); ++i)
        consider_face(polygon[i], polygon[(i + 1) % polygon.size()], nearest);
  }
  if (!std::isfinite(nearest.best_m) || nearest.at_rim) return std::nullopt;
  return ExpectedEcho{nearest.best_m, (nearest.from_m - nearest.target_m) / nearest.best_m, 0.0};
}

struct Crossing {
  double range_m = std::numeric_limits<double>::infinity();
  Point normal{0.0, 0.0};
};

Crossing first_crossing(const Contour& contour, const Point& from_m, const Point& ray) {
  Crossing first;
  if (contour.is_circle()) {
    const double radius_m = 0.5 * contour.circle_diameter_m;
    const double along_m = -ray.dot(from_m);
    const double missed_m = cross(ray, from_m);
    if (std::abs(missed_m) >= radius_m || along_m <= 0.0) return first;
    first.range_m = along_m - std::sqrt(radius_m * radius_m - missed_m * missed_m);
    first.normal = (from_m + first.range_m * ray) / radius_m;
    return first;
  }
  for (const auto& polygon : contour.polygons_m)
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point& a = polygon[i];
      const Point along = polygon[(i + 1) % polygon.size()] - a;
      const double turn = cross(ray, along);
      if (std::abs(turn) < 1e-12) continue;
      const double range_m = cross(a - from_m, along) / turn;
      const double at = cross(a - from_m, ray) / turn;
      if (range_m <= 0.0 || range_m >= first.range_m || at < 0.0 || at > 1.0) continue;
      first = {range_m, Point(along.y(), -along.x()).normalized()};
    }
  return first;
}

std::optional<ExpectedEcho> ray_echo(const Contour& contour, const Pose2& T_contour_sensor) {
  const Point ray = T_contour_sensor.direction();
  const Crossing first = first_crossing(contour, T_contour_sensor.position(), ray);
  const double incidence = -first.normal.dot(ray);
  if (!std::isfinite(first.range_m) || incidence < kMinIncidence) return std::nullopt;
  const Point turned(-ray.y(), ray.x());
  return ExpectedEcho{first.range_m, first.normal / incidence, first.range_m * first.normal.dot(turned) / incidence};
}

}  // namespace

std::optional<ExpectedEcho> expected_echo(const Contour& contour, const Pose2& T_contour_sensor, double half_beam_rad) {
  if (contour.signed_distance(T_contour_sensor.position()) < kOnTop_m) return std::nullopt;
  return half_beam_rad > 0.0 ? cone_echo(contour, T_contour_sensor, half_beam_rad)
                             : ray_echo(contour, T_contour_sensor);
}

}  // namespace cairn::odometry_compass
