#include "framework/experiments/homes/tag_sight.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr int kSidesOfRound = 72;
constexpr double kWithBorderRatio = 1.25;  // of a tag's size: with the white border
constexpr double kBeforeFace_m = 0.02;
constexpr double kEdge_px = 2.0;  // of the picture

bool crosses(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c);
  const double b_side = cross(d - c, b - c);
  return c_side * d_side <= 0.0 && a_side * b_side <= 0.0;
}

// p: in the camera's frame on the floor plan; up_m: above the lens.
bool is_in_picture(const CameraModel& camera, const Point& p, double up_m) {
  const double c = std::cos(camera.tilt_rad);
  const double s = std::sin(camera.tilt_rad);
  const double depth_m = c * p.x() + s * up_m;
  if (depth_m < 0.05) return false;
  const double x_px = camera.centre_x_px - camera.focal_x_px * p.y() / depth_m;
  const double y_px = camera.centre_y_px + camera.focal_y_px * (s * p.x() - c * up_m) / depth_m;
  return x_px > kEdge_px && x_px < camera.width_px - 1 - kEdge_px && y_px > kEdge_px &&
         y_px < camera.height_px - 1 - kEdge_px;
}

}  // namespace

TagSight::TagSight(const World& world) {
  for (const WorldWall& wall : world.walls)
    for (std::size_t i = 1; i < wall.points_m.size(); ++i)
      faces_m_.emplace_back(wall.points_m[i - 1], wall.points_m[i]);
  for (const WorldObject& object : world.objects)
    for (const std::vector<Point>& corners : object.contour.outlines_m(kSidesOfRound))
      for (std::size_t i = 0; i < corners.size(); ++i)
        faces_m_.emplace_back(object.T_map_object * corners[i],
                              object.T_map_object * corners[(i + 1) % corners.size()]);
}

bool TagSight::is_free(const Point& from_m, const Point& to_m) const {
  return std::ranges::none_of(faces_m_,
                              [&](const auto& face) { return crosses(from_m, to_m, face.first, face.second); });
}

std::optional<TagSighted> TagSight::of(const WorldTag& tag, const CameraModel& camera, const Pose2& T_map_robot,
                                       const SightLimits& limits) const {
  const Pose2 T_map_camera = T_map_robot * camera.T_robot_camera;
  const Pose2 T_tag_camera = inverse(tag.T_map_tag) * T_map_camera;
  const double distance_m = T_tag_camera.position().norm();
  const double slant_rad = std::atan2(T_tag_camera.y_m, T_tag_camera.x_m);
  if (distance_m > limits.max_distance_m || std::abs(slant_rad) > limits.max_slant_rad) return std::nullopt;
  const double half_m = 0.5 * kWithBorderRatio * tag.size_m;
  for (const double across_m : {-half_m, 0.0, half_m}) {
    const Point at_m = tag.T_map_tag * Point(kBeforeFace_m, across_m);
    if (!is_free(T_map_camera.position(), at_m)) return std::nullopt;
    const Point p_camera = inverse(T_map_camera) * at_m;
    for (const double up_m : {-half_m, half_m})
      if (!is_in_picture(camera, p_camera, tag.height_m + up_m - camera.height_m)) return std::nullopt;
  }
  return TagSighted{distance_m, slant_rad};
}

}  // namespace cairn
