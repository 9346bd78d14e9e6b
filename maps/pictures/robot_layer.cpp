#include "maps/pictures/robot_layer.hpp"

#include <algorithm>
#include <cmath>

#include "maps/pictures/drawing/colours.hpp"

namespace cairn::pictures {
namespace {

constexpr double kApartSizes = 1.5;  // of the robot
constexpr double kApart_px = 70.0;
constexpr Fill kGround{kRobot, 0.14};
constexpr Stroke kRim{kRobot, 1.5, 0.85};

bool is_placed(const Pose2& pose) {
  return is_drawable(pose.position()) && std::isfinite(pose.theta_rad);
}

Pose2 between(const Pose2& a, const Pose2& b, double share) {
  const Point at = a.position() + share * (b.position() - a.position());
  return {at.x(), at.y(), a.theta_rad + share * wrap_angle(b.theta_rad - a.theta_rad)};
}

// A line from the robot's origin to its front says where it looks; a disc may look anywhere.
void draw_outline(Canvas& canvas, const std::vector<Pixel>& corners, const Pixel& origin, const Pixel& front) {
  canvas.fill_polygon(corners, kGround);
  canvas.outline(corners, kRim);
  canvas.line(std::vector<Pixel>{origin, front}, kRim);
}

void draw_disc(Canvas& canvas, const Pixel& at, double radius_px) {
  canvas.fill_disc(at, radius_px, kGround);
  canvas.ring(at, radius_px, kRim);
}

double front_of(const std::vector<Point>& polygon_m) {
  double front_m = 0.0;
  for (const Point& corner : polygon_m) front_m = std::max(front_m, corner.x());
  return front_m;
}

}  // namespace

double RobotShape::reach_m() const {
  double max_m = polygon_m.empty() ? radius_m : 0.0;
  for (const Point& corner : polygon_m) max_m = std::max(max_m, corner.norm());
  return max_m;
}

std::vector<Pose2> spread_along(const std::vector<Pose2>& path, double apart_m) {
  if (path.empty() || !std::ranges::all_of(path, is_placed)) return {};
  std::vector<double> along_m{0.0};
  for (std::size_t i = 1; i < path.size(); ++i)
    along_m.push_back(along_m.back() + (path[i].position() - path[i - 1].position()).norm());
  const double steps = std::floor(along_m.back() / apart_m);
  std::vector<Pose2> chosen{path.front()};
  for (double step = 1.0; step < steps; ++step) {
    const double at_m = step / steps * along_m.back();
    const auto next = static_cast<std::size_t>(std::ranges::upper_bound(along_m, at_m) - along_m.begin());
    const double from_m = along_m[next - 1];
    chosen.push_back(between(path[next - 1], path[next], (at_m - from_m) / (along_m[next] - from_m)));
  }
  if (path.size() > 1) chosen.push_back(path.back());
  return chosen;
}

void draw_robot_along(Canvas& canvas, const MapFrame& frame, const RobotShape& shape, const std::vector<Pose2>& path) {
  const double reach_m = shape.reach_m();
  if (!(reach_m > 0.0)) return;
  const double apart_m = std::max(2.0 * kApartSizes * reach_m, kApart_px / frame.px_per_m);
  for (const Pose2& pose : spread_along(path, apart_m)) {
    if (shape.polygon_m.empty()) {
      draw_disc(canvas, frame.pixel_of(pose.position()), shape.radius_m * frame.px_per_m);
      continue;
    }
    std::vector<Point> corners;
    for (const Point& corner : shape.polygon_m) corners.push_back(pose * corner);
    draw_outline(canvas, frame.pixels_of(corners), frame.pixel_of(pose.position()),
                 frame.pixel_of(pose * Point(front_of(shape.polygon_m), 0.0)));
  }
}

LegendEntry robot_entry(const RobotShape& shape) {
  const Pixel room(22.0, 13.0);
  return {"robot", [shape, room](Canvas& canvas, const Pixel& at) {
            if (shape.polygon_m.empty()) return draw_disc(canvas, at, room.y() / 2.0);
            Point low = shape.polygon_m.front();
            Point high = low;
            for (const Point& corner : shape.polygon_m) {
              low = low.cwiseMin(corner);
              high = high.cwiseMax(corner);
            }
            const double px_per_m = (room.array() / (high - low).array()).minCoeff();
            const auto pixel_of = [&](const Point& p) -> Pixel {
              const Point from_middle = px_per_m * (p - (low + high) / 2.0);
              return at + Pixel(from_middle.x(), -from_middle.y());
            };
            std::vector<Pixel> corners;
            for (const Point& corner : shape.polygon_m) corners.push_back(pixel_of(corner));
            draw_outline(canvas, corners, pixel_of({0.0, 0.0}), pixel_of({front_of(shape.polygon_m), 0.0}));
          }};
}

}  // namespace cairn::pictures
