#include "plugins/simulated_robot/sonar_echo.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kPolaroidHalfBeam_rad = radians(15.0);
constexpr double kMainLobeRim_db = -12.0;  // a parabola that is 3 dB down at half the lobe
constexpr double kNearField_m = 0.1;       // no louder than at this range
constexpr double kLift_m = 1e-7;           // off a mirror, so that a bounced ray does not meet it again
constexpr double kSilent_db = -1e9;

}  // namespace

struct SonarEcho::Receiver {
  Point at_m;
  double axis_rad;
  double best_m;  // shortest echo so far, or the reach
  bool echo_range = false;

  void add_echo(double length_m) {
    best_m = length_m;
    echo_range = true;
  }
};

SonarEcho::SonarEcho(const EchoConfig& config, const Scene& scene, double half_beam_rad)
    : config_(config), scene_(scene), half_beam_rad_(half_beam_rad) {
  const double scale = half_beam_rad / kPolaroidHalfBeam_rad;
  side_lobe_rad_ = config.side_lobe_rad * scale;
  far_side_lobe_rad_ = config.far_side_lobe_rad * scale;
  const double rim_rad = std::max({half_beam_rad, side_lobe_rad_, far_side_lobe_rad_});
  const double spacing_rad = 2.0 * rim_rad / std::max(config.rays - 1, 1);
  retro_cosine_ = std::cos(0.6 * spacing_rad);
  if (half_beam_rad <= 0.0) return;
  for (int i = 0; i < config.rays; ++i) {
    Ray ray{(i - 0.5 * (config.rays - 1)) * spacing_rad, 0.0, 0.0};
    ray.gain_db = 2.0 * gain_db(std::max(std::abs(ray.offset_rad) - 1e-9, 0.0));
    double too_far_m = 1000.0;
    for (int step = 0; step < 60; ++step) {
      const double middle_m = 0.5 * (ray.reach_m + too_far_m);
      (ray.gain_db + loss_db(middle_m) >= config.threshold_db ? ray.reach_m : too_far_m) = middle_m;
    }
    rays_.push_back(ray);
  }
  // The axis first: its echoes cut the work of the rest.
  std::stable_sort(rays_.begin(), rays_.end(),
                   [](const Ray& p, const Ray& q) { return std::abs(p.offset_rad) < std::abs(q.offset_rad); });
}

double SonarEcho::gain_db(double off_axis_rad) const {
  if (off_axis_rad <= half_beam_rad_) return kMainLobeRim_db * std::pow(off_axis_rad / half_beam_rad_, 2);
  if (off_axis_rad <= side_lobe_rad_) return config_.side_lobe_db;
  return off_axis_rad <= far_side_lobe_rad_ ? config_.far_side_lobe_db : kSilent_db;
}

double SonarEcho::loss_db(double range_m) const {
  const double range = std::max(range_m, kNearField_m);
  return -20.0 * std::log10(range) - config_.absorption_db_per_m * (range - 1.0);
}

// A cylinder spreads what a flat mirror would send back (target strength a / (a + r)).
double SonarEcho::round_db(double range_m, double radius_m, bool rough) const {
  const double mirror_db = -10.0 * std::log10(1.0 + range_m / radius_m);
  return rough ? std::max(mirror_db, config_.rough_db) : mirror_db;
}

std::optional<double> SonarEcho::first_echo(const Pose2& T_map_sonar, double reach_m) const {
  Receiver receiver{T_map_sonar.position(), T_map_sonar.theta_rad, reach_m};
  if (half_beam_rad_ <= 0.0) {
    const RayHit hit = scene_.cast(receiver.at_m, T_map_sonar.direction(), reach_m);
    return std::isinf(hit.distance_m) ? std::nullopt : std::optional(hit.distance_m);
  }
  add_face_echoes(receiver);
  add_round_face_echoes(receiver);
  add_vertex_echoes(receiver);
  for (const Ray& ray : rays_) add_ray(ray, receiver);
  return receiver.echo_range ? std::optional(receiver.best_m) : std::nullopt;
}

void SonarEcho::consider(const Point& target_m, double target_db, Receiver& receiver) const {
  const Point offset = target_m - receiver.at_m;
  const double range_m = offset.norm();
  if (range_m >= receiver.best_m) return;
  const double off_axis_rad = std::abs(wrap_angle(std::atan2(offset.y(), offset.x()) - receiver.axis_rad));
  if (target_db + 2.0 * gain_db(off_axis_rad) + loss_db(range_m) < config_.threshold_db) return;
  if (scene_.sees(receiver.at_m, target_m)) receiver.add_echo(range_m);
}

void SonarEcho::add_face_echoes(Receiver& receiver) const {
  for (const Face& face : scene_.faces()) {
    const double height_m = (receiver.at_m - face.a_m).dot(face.normal);
    if (std::abs(height_m) >= receiver.best_m) continue;
    const Point foot_m = receiver.at_m - height_m * face.normal;
    if ((foot_m - face.a_m).dot(foot_m - face.b_m) > 0.0) continue;
    consider(foot_m, face.rough ? config_.rough_db : 0.0, receiver);
  }
}

void SonarEcho::add_round_face_echoes(Receiver& receiver) const {
  for (const RoundFace& face : scene_.round_faces()) {
    const Point offset = face.centre_m - receiver.at_m;
    const double range_m = offset.norm() - face.radius_m;
    if (range_m <= 0.0 || range_m >= receiver.best_m) continue;
    consider(face.centre_m - face.radius_m * offset.normalized(), round_db(range_m, face.radius_m, face.rough),
             receiver);
  }
}

void SonarEcho::add_vertex_echoes(Receiver& receiver) const {
  for (const Vertex& vertex : scene_.vertices()) {
    if ((vertex.at_m - receiver.at_m).squaredNorm() >= receiver.best_m * receiver.best_m) continue;
    const VertexLook look = vertex.look_from(receiver.at_m);
    if (look == VertexLook::nothing) continue;
    consider(vertex.at_m, look == VertexLook::edge ? config_.edge_db : config_.bounce_db, receiver);
  }
}

void SonarEcho::add_ray(const Ray& ray, Receiver& receiver) const {
  Point from_m = receiver.at_m;
  const double bearing_rad = receiver.axis_rad + ray.offset_rad;
  Point direction(std::cos(bearing_rad), std::sin(bearing_rad));
  double level_db = ray.gain_db;
  double length_m = 0.0;
  for (int bounce = 0; bounce <= config_.max_bounces; ++bounce) {
    const RayHit hit = scene_.cast(from_m, direction, std::min(receiver.best_m, ray.reach_m) - length_m);
    if (std::isinf(hit.distance_m)) return;
    length_m += hit.distance_m;
    const double cosine = -direction.dot(hit.normal);
    const bool straight = cosine >= retro_cosine_;
    if (hit.rough || straight || hit.round_radius_m > 0.0) {
      // Straight on a mirror without a bounce is the foot of the perpendicular, found already.
      if (!hit.rough && (!straight || bounce == 0)) return;
      const double target_db = hit.rough                  ? config_.rough_db + 20.0 * std::log10(std::max(cosine, 1e-6))
                               : hit.round_radius_m > 0.0 ? round_db(length_m, hit.round_radius_m, false)
                                                          : 0.0;
      if (level_db + target_db + loss_db(length_m) >= config_.threshold_db) receiver.add_echo(length_m);
      return;
    }
    from_m += hit.distance_m * direction + kLift_m * hit.normal;
    direction += 2.0 * cosine * hit.normal;
    level_db += config_.bounce_db;
  }
}

}  // namespace cairn
