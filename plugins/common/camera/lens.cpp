#include "plugins/common/camera/lens.hpp"

#include <cmath>

namespace cairn {
namespace {

// Brown's model in OpenCV's order.
Eigen::Vector2d distorted(const CameraModel& camera, const Eigen::Vector2d& p) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {p.x() * radial + 2.0 * p1 * p.x() * p.y() + p2 * (r2 + 2.0 * p.x() * p.x()),
          p.y() * radial + p1 * (r2 + 2.0 * p.y() * p.y()) + 2.0 * p2 * p.x() * p.y()};
}

}  // namespace

Eigen::Vector2d undistorted(const CameraModel& camera, const Pixel& pixel) {
  constexpr int kMaxSteps = 50;
  constexpr double kSame = 1e-10;
  const Eigen::Vector2d seen{(pixel.x() - camera.centre_x_px) / camera.focal_x_px,
                             (pixel.y() - camera.centre_y_px) / camera.focal_y_px};
  Eigen::Vector2d p = seen;
  Eigen::Vector2d off = seen - distorted(camera, p);
  for (int i = 0; i < kMaxSteps && off.norm() > kSame; ++i) {
    const Eigen::Vector2d next = p + off;
    const Eigen::Vector2d next_off = seen - distorted(camera, next);
    if (!(next_off.norm() < off.norm())) break;
    p = next;
    off = next_off;
  }
  return p;
}

Eigen::Vector3d direction_of(const CameraModel& camera, const Eigen::Vector2d& on_plane) {
  const double c = std::cos(camera.tilt_rad);
  const double s = std::sin(camera.tilt_rad);
  return {c + on_plane.y() * s, -on_plane.x(), s - on_plane.y() * c};
}

std::optional<Pixel> pixel_of(const CameraModel& camera, const Eigen::Vector3d& p_robot_m) {
  const Point p_camera = inverse(camera.T_robot_camera) * Point(p_robot_m.x(), p_robot_m.y());
  const double up_m = p_robot_m.z() - camera.height_m;
  const double c = std::cos(camera.tilt_rad);
  const double s = std::sin(camera.tilt_rad);
  const double depth_m = c * p_camera.x() + s * up_m;
  if (depth_m <= 1e-6) return std::nullopt;
  const double down_m = s * p_camera.x() - c * up_m;
  const Eigen::Vector2d p = distorted(camera, {-p_camera.y() / depth_m, down_m / depth_m});
  return Pixel{camera.focal_x_px * p.x() + camera.centre_x_px, camera.focal_y_px * p.y() + camera.centre_y_px};
}

}  // namespace cairn
