#include "plugins/simulated_robot/surroundings/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

constexpr double kSamePlace_m = 1e-3;  // world files are written to the millimetre
constexpr double kOverlap_ratio = 1e-9;
constexpr double kNone = std::numeric_limits<double>::infinity();

double bearing(const Point& d) {
  return wrap_angle(std::atan2(d.y(), d.x()));
}

// Distance along the ray to a segment, or infinity.
double along_ray_to_face(const Point& from, const Point& direction, const Face& face) {
  const Point edge = face.b_m - face.a_m;
  const Point to_a = face.a_m - from;
  const double turn = cross(direction, edge);
  const double along = cross(to_a, edge);
  const double share = cross(to_a, direction);
  // Signs first: a division only for faces that the ray does cross. The ends reach out a little, so
  // that no ray slips through where two faces meet.
  const double low = -kOverlap_ratio * turn;
  const double high = turn - low;
  if (turn > 0.0 ? (along <= 0.0 || share < low || share > high) : (along >= 0.0 || share > low || share < high)) {
    return kNone;
  }
  return turn == 0.0 ? kNone : along / turn;
}

double along_ray_to_round(const Point& from, const Point& direction, const RoundFace& face) {
  const Point to_centre = face.centre_m - from;
  const double middle = to_centre.dot(direction);
  const double outside = to_centre.squaredNorm() - face.radius_m * face.radius_m;
  const double half_chord_squared = middle * middle - outside;
  if (middle <= 0.0 || outside <= 0.0 || half_chord_squared < 0.0) return kNone;
  return middle - std::sqrt(half_chord_squared);
}

}  // namespace

VertexLook Vertex::look_from(const Point& eye_m) const {
  const double eye = bearing(eye_m - at_m);
  // The arms on either side of the eye, going round.
  const auto above = std::upper_bound(arms.begin(), arms.end(), eye,
                                      [](double angle, const Arm& arm) { return angle < arm.bearing_rad; });
  const Arm& left = above == arms.end() ? arms.front() : *above;
  const Arm& right = above == arms.begin() ? arms.back() : *std::prev(above);
  double opening = left.bearing_rad - right.bearing_rad;
  if (opening <= 0.0) opening += 2.0 * std::numbers::pi;
  if (opening > radians(200.0)) return VertexLook::edge;
  const bool square = std::abs(opening - radians(90.0)) < radians(5.0);
  return square && !left.rough && !right.rough ? VertexLook::square_corner : VertexLook::nothing;
}

Scene::Scene(const World& world) {
  for (const WorldWall& wall : world.walls) {
    for (std::size_t i = 1; i < wall.points_m.size(); ++i) {
      add_face(wall.points_m[i - 1], wall.points_m[i], wall.surface == Surface::rough);
    }
  }
  for (const WorldObject& object : world.objects) {
    const bool rough = object.surface == Surface::rough;
    if (object.contour.is_circle()) {
      round_faces_.push_back({object.T_map_object.position(), 0.5 * object.contour.circle_diameter_m, rough});
      continue;
    }
    for (const std::vector<Point>& corners : object.contour.polygons_m) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        add_face(object.T_map_object * corners[i], object.T_map_object * corners[(i + 1) % corners.size()], rough);
      }
    }
  }
  collect_vertices();
  fixed_faces_ = faces_.size();
  fixed_round_faces_ = round_faces_.size();
  fixed_vertices_ = vertices_.size();
}

void Scene::show(const Scene& outline, const Point& shift_m, int mover) {
  for (Face face : outline.faces_) {
    face.a_m += shift_m;
    face.b_m += shift_m;
    face.mover = mover;
    faces_.push_back(face);
  }
  for (RoundFace face : outline.round_faces_) {
    face.centre_m += shift_m;
    face.mover = mover;
    round_faces_.push_back(face);
  }
  for (Vertex vertex : outline.vertices_) {
    vertex.at_m += shift_m;
    vertices_.push_back(std::move(vertex));
  }
}

void Scene::clear_moving() {
  faces_.erase(faces_.begin() + static_cast<std::ptrdiff_t>(fixed_faces_), faces_.end());
  round_faces_.erase(round_faces_.begin() + static_cast<std::ptrdiff_t>(fixed_round_faces_), round_faces_.end());
  vertices_.erase(vertices_.begin() + static_cast<std::ptrdiff_t>(fixed_vertices_), vertices_.end());
}

void Scene::add_face(const Point& a_m, const Point& b_m, bool rough) {
  const Point edge = b_m - a_m;
  if (edge.norm() == 0.0) return;
  faces_.push_back({a_m, b_m, Point(-edge.y(), edge.x()).normalized(), rough});
}

void Scene::collect_vertices() {
  const auto known = [this](const Point& p) {
    return std::any_of(vertices_.begin(), vertices_.end(),
                       [&](const Vertex& vertex) { return (vertex.at_m - p).norm() < kSamePlace_m; });
  };
  for (const Face& face : faces_) {
    for (const Point& end : {face.a_m, face.b_m}) {
      if (known(end)) continue;
      Vertex vertex{end, {}};
      // A face that only touches with its middle leaves in both directions: a wall built onto another.
      for (const Face& other : faces_) {
        if (distance_to_segment_m(end, other.a_m, other.b_m) >= kSamePlace_m) continue;
        for (const Point& far_end : {other.a_m, other.b_m}) {
          if ((far_end - end).norm() >= kSamePlace_m) vertex.arms.push_back({bearing(far_end - end), other.rough});
        }
      }
      std::sort(vertex.arms.begin(), vertex.arms.end(),
                [](const Vertex::Arm& p, const Vertex::Arm& q) { return p.bearing_rad < q.bearing_rad; });
      if (!vertex.arms.empty()) vertices_.push_back(std::move(vertex));
    }
  }
}

RayHit Scene::cast(const Point& from_m, const Point& direction, double reach_m) const {
  RayHit hit;
  double nearest = reach_m;
  const Face* face_hit = nullptr;
  const RoundFace* round_hit = nullptr;
  for (const Face& face : faces_) {
    const double distance = along_ray_to_face(from_m, direction, face);
    if (distance < nearest) {
      nearest = distance;
      face_hit = &face;
    }
  }
  for (const RoundFace& face : round_faces_) {
    const double distance = along_ray_to_round(from_m, direction, face);
    if (distance < nearest) {
      nearest = distance;
      round_hit = &face;
    }
  }
  if (face_hit == nullptr && round_hit == nullptr) return hit;
  hit.distance_m = nearest;
  hit.round_radius_m = round_hit != nullptr ? round_hit->radius_m : 0.0;
  hit.rough = round_hit != nullptr ? round_hit->rough : face_hit->rough;
  hit.normal = round_hit != nullptr ? Point((from_m + nearest * direction - round_hit->centre_m) / round_hit->radius_m)
                                    : face_hit->normal;
  if (hit.normal.dot(direction) > 0.0) hit.normal = -hit.normal;
  return hit;
}

namespace {

// visit(i) for the rays of the fan whose bearings lie within [low_rad, high_rad], and a neighbour to each side.
template <class Visit>
void for_rays_between(const RayFan& fan, std::size_t rays, double low_rad, double high_rad, const Visit& visit) {
  const auto count = static_cast<std::ptrdiff_t>(rays);
  if (fan.step_rad == 0.0) {
    for (std::ptrdiff_t i = 0; i < count; ++i) visit(static_cast<std::size_t>(i));
    return;
  }
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double first_rad = std::min(fan.first_rad, fan.first_rad + fan.step_rad * static_cast<double>(count - 1));
  // The first turn in which the interval may reach into the fan.
  double shift_rad = kTurn * std::floor((first_rad - high_rad) / kTurn);
  const double fan_end_rad = first_rad + std::abs(fan.step_rad) * static_cast<double>(count - 1);
  for (; low_rad + shift_rad <= fan_end_rad + std::abs(fan.step_rad); shift_rad += kTurn) {
    double from = (low_rad + shift_rad - fan.first_rad) / fan.step_rad;
    double to = (high_rad + shift_rad - fan.first_rad) / fan.step_rad;
    if (from > to) std::swap(from, to);
    const auto begin = std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(std::floor(from)) - 1);
    const auto end = std::min<std::ptrdiff_t>(count, static_cast<std::ptrdiff_t>(std::ceil(to)) + 2);
    for (std::ptrdiff_t i = begin; i < end; ++i) visit(static_cast<std::size_t>(i));
  }
}

}  // namespace

void Scene::cast_fan(const RayFan& fan, std::span<double> distances_m) const {
  std::vector<Point> directions(distances_m.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double bearing_rad = fan.first_rad + static_cast<double>(i) * fan.step_rad;
    directions[i] = {std::cos(bearing_rad), std::sin(bearing_rad)};
  }
  std::ranges::fill(distances_m, fan.reach_m);
  const auto look_along = [&](const Face& face, double middle_rad, double half_rad) {
    for_rays_between(fan, directions.size(), middle_rad - half_rad, middle_rad + half_rad, [&](std::size_t i) {
      distances_m[i] = std::min(distances_m[i], along_ray_to_face(fan.from_m, directions[i], face));
    });
  };
  for (const Face& face : faces_) {
    if (distance_to_segment_m(fan.from_m, face.a_m, face.b_m) >= fan.reach_m) continue;
    const double a_rad = bearing(face.a_m - fan.from_m);
    const double half_rad = 0.5 * wrap_angle(bearing(face.b_m - fan.from_m) - a_rad);
    // Of a place on the face itself, either side may be meant.
    if (std::abs(half_rad) > 0.5 * std::numbers::pi - 1e-6) {
      look_along(face, 0.0, std::numbers::pi);
      continue;
    }
    look_along(face, a_rad + half_rad, std::abs(half_rad));
  }
  for (const RoundFace& face : round_faces_) {
    const Point to_centre = face.centre_m - fan.from_m;
    const double centre_m = to_centre.norm();
    if (centre_m <= face.radius_m || centre_m - face.radius_m >= fan.reach_m) continue;
    const double half_rad = std::asin(face.radius_m / centre_m);
    const double middle_rad = bearing(to_centre);
    for_rays_between(fan, directions.size(), middle_rad - half_rad, middle_rad + half_rad, [&](std::size_t i) {
      distances_m[i] = std::min(distances_m[i], along_ray_to_round(fan.from_m, directions[i], face));
    });
  }
  for (double& distance_m : distances_m)
    if (distance_m >= fan.reach_m) distance_m = kNone;
}

bool Scene::sees(const Point& from_m, const Point& target_m) const {
  const Point offset = target_m - from_m;
  const double distance = offset.norm();
  if (distance <= kSamePlace_m) return true;
  return std::isinf(cast(from_m, offset / distance, distance - kSamePlace_m).distance_m);
}

}  // namespace cairn
