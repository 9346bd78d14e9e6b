#include "plugins/simulated_robot/surroundings/body.hpp"

#include <algorithm>
#include <cmath>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

constexpr double kCreep_m = 2e-4;   // shortest step, for what slides along a wall
constexpr int kHalvings = 12;       // of the step that touches: the gap left is 2^-12 of it
constexpr double kNearby_m = 0.05;  // nearer than this a polygon footprint is measured edge by edge

double distance_between(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto side = [](const Point& p, const Point& q, const Point& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
  };
  if (side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0) return -kCreep_m;  // they cross
  return std::min({distance_to_segment_m(a, c, d), distance_to_segment_m(b, c, d), distance_to_segment_m(c, a, b),
                   distance_to_segment_m(d, a, b)});
}

}  // namespace

Pose2 along_arc(double distance_m, double turn_rad) {
  const double half = 0.5 * turn_rad;
  // The chord of the arc; its series where the quotient would lose digits.
  const double chord_m = distance_m * (std::abs(half) < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half);
  return {chord_m * std::cos(half), chord_m * std::sin(half), wrap_angle(turn_rad)};
}

Body::Body(const RobotModel& robot, const Scene& scene)
    : radius_m_(robot.radius_m), polygon_m_(robot.polygon_m), scene_(scene) {
  for (const Point& corner : polygon_m_) radius_m_ = std::max(radius_m_, corner.norm());
}

double Body::clearance_m(const Pose2& T_map_robot) const {
  const Point at_m = T_map_robot.position();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Face& face : scene_.faces())
    nearest_m = std::min(nearest_m, distance_to_segment_m(at_m, face.a_m, face.b_m));
  for (const RoundFace& face : scene_.round_faces()) {
    nearest_m = std::min(nearest_m, (face.centre_m - at_m).norm() - face.radius_m);
  }
  nearest_m -= radius_m_;
  return polygon_m_.empty() || nearest_m > kNearby_m ? nearest_m : footprint_clearance_m(T_map_robot);
}

double Body::footprint_clearance_m(const Pose2& T_map_robot) const {
  std::vector<Point> corners_m;
  corners_m.reserve(polygon_m_.size());
  for (const Point& corner : polygon_m_) corners_m.push_back(T_map_robot * corner);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    const Point& a = corners_m[i];
    const Point& b = corners_m[(i + 1) % corners_m.size()];
    for (const Face& face : scene_.faces()) nearest_m = std::min(nearest_m, distance_between(a, b, face.a_m, face.b_m));
    for (const RoundFace& face : scene_.round_faces()) {
      nearest_m = std::min(nearest_m, distance_to_segment_m(face.centre_m, a, b) - face.radius_m);
    }
  }
  return nearest_m;
}

// No point of the footprint moves farther than sweep_m on the whole path.
template <class PoseAt>
double Body::furthest(Pose2& T_map_robot, double sweep_m, double gap_m, PoseAt pose_at) const {
  double clear_m = clearance_m(T_map_robot) - gap_m;
  const auto go_to = [&](double share) {
    const Pose2 T_map_next = pose_at(share);
    const double next_clear_m = clearance_m(T_map_next) - gap_m;
    if (next_clear_m < 0.0 && next_clear_m < clear_m) return false;
    T_map_robot = T_map_next;
    clear_m = next_clear_m;
    return true;
  };
  double done = 0.0;
  while (done < 1.0) {
    // A little less than the clearance, so that rounding never makes a touch of it.
    const double step_m = std::max(0.999 * clear_m, kCreep_m);
    const double next = step_m >= sweep_m * (1.0 - done) ? 1.0 : done + step_m / sweep_m;
    if (go_to(next)) {
      done = next;
      continue;
    }
    double step = next - done;
    for (int i = 0; i < kHalvings; ++i) {
      step *= 0.5;
      if (go_to(done + step)) done += step;
    }
    return done;
  }
  return 1.0;
}

double Body::free_share(Pose2& T_map_robot, double distance_m, double turn_rad) const {
  // A disc that turns sweeps nothing new.
  const double sweep_m = std::abs(distance_m) + (polygon_m_.empty() ? 0.0 : radius_m_ * std::abs(turn_rad));
  if (sweep_m == 0.0) {
    T_map_robot = T_map_robot * along_arc(distance_m, turn_rad);
    return 1.0;
  }
  const Pose2 T_map_from = T_map_robot;
  return furthest(T_map_robot, sweep_m, 0.0,
                  [&](double share) { return T_map_from * along_arc(share * distance_m, share * turn_rad); });
}

double Body::slide(const Pose2& T_map_robot, const Point& way_m, double gap_m) const {
  Pose2 T_map_slid = T_map_robot;
  return furthest(T_map_slid, way_m.norm(), gap_m, [&](double share) {
    return Pose2{T_map_robot.x_m + share * way_m.x(), T_map_robot.y_m + share * way_m.y(), T_map_robot.theta_rad};
  });
}

Nearest Body::nearest(const Pose2& T_map_robot) const {
  std::vector<Point> corners_m;
  for (const Point& corner : polygon_m_) corners_m.push_back(T_map_robot * corner);
  // A disc is measured from its centre.
  if (corners_m.empty()) corners_m.push_back(T_map_robot.position());
  const double radius_m = polygon_m_.empty() ? radius_m_ : 0.0;
  Nearest best;
  const auto consider = [&](const Point& from_m, const Point& at_m, const Face* face, const RoundFace* round_face) {
    const double distance_m = (at_m - from_m).norm() - radius_m;
    if (distance_m < best.distance_m) best = {at_m, distance_m, face, round_face};
  };
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    const Point& a = corners_m[i];
    const Point& b = corners_m[(i + 1) % corners_m.size()];
    for (const Face& face : scene_.faces()) {
      consider(a, nearest_on_segment(a, face.a_m, face.b_m), &face, nullptr);
      for (const Point& end : {face.a_m, face.b_m}) consider(nearest_on_segment(end, a, b), end, &face, nullptr);
    }
    for (const RoundFace& face : scene_.round_faces()) {
      const Point from_m = nearest_on_segment(face.centre_m, a, b);
      consider(from_m, face.centre_m + face.radius_m * (from_m - face.centre_m).normalized(), nullptr, &face);
    }
  }
  return best;
}

Move Body::drive(Pose2& T_map_robot, double distance_m, double turn_rad) const {
  const double share = free_share(T_map_robot, distance_m, turn_rad);
  Move move{share * distance_m, share * turn_rad, share < 1.0, T_map_robot};
  if (move.touched && distance_m != 0.0) {
    const double left_rad = (1.0 - share) * turn_rad;
    move.turn_rad += free_share(T_map_robot, 0.0, left_rad) * left_rad;
  }
  return move;
}

std::optional<std::string> blocker_at(const Pose2& T_map_robot, const RobotModel& robot, const World& world) {
  const Point at_m = T_map_robot.position();
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    World alone;
    alone.walls = {world.walls[i]};
    const Scene scene(alone);
    if (Body(robot, scene).clearance_m(T_map_robot) < 0.0) return "wall " + std::to_string(i + 1);
  }
  for (std::size_t i = 0; i < world.objects.size(); ++i) {
    const WorldObject& object = world.objects[i];
    World alone;
    alone.objects = {object};
    const Scene scene(alone);
    const bool inside = object.contour.signed_distance(inverse(object.T_map_object) * at_m) < 0.0;
    if (!inside && Body(robot, scene).clearance_m(T_map_robot) >= 0.0) continue;
    const std::string kind = !object.category.empty()     ? object.category
                             : object.contour.is_circle() ? "a circle"
                                                          : "a polygon";
    return "object " + std::to_string(i + 1) + " (" + kind + ")";
  }
  return std::nullopt;
}

}  // namespace cairn
