// Which echo a transducer receives first, without noise (docs/method.md 14.1).
//
// Direct echoes are found exactly: the foot of the perpendicular on every face, the nearest point of
// every round face, every vertex. Rays over all lobes find the rest: rough faces hit at an angle, and
// what comes back after mirror bounces, whose reading is the whole length and so too long. An echo
// counts when its level passes the threshold; the shortest path wins.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "plugins/simulated_robot/config.hpp"
#include "plugins/simulated_robot/surroundings/scene.hpp"

namespace cairn {

class SonarEcho {
 public:
  // The scene must outlive the object. half_beam_rad 0: a plain ray that every surface answers.
  SonarEcho(const EchoConfig& config, const Scene& scene, double half_beam_rad);

  // Length of the shortest path of an echo, at most reach_m. Thread-safe.
  [[nodiscard]] std::optional<double> first_echo(const Pose2& T_map_sonar, double reach_m) const;

 private:
  struct Ray {
    double offset_rad;
    double gain_db;  // both ways
    double reach_m;  // of the best target there is
  };
  struct Receiver;  // one call's eye point, axis and best echo so far

  [[nodiscard]] double gain_db(double off_axis_rad) const;
  [[nodiscard]] double loss_db(double range_m) const;
  [[nodiscard]] double round_db(double range_m, double radius_m, bool rough) const;
  void add_face_echoes(Receiver& receiver) const;
  void add_round_face_echoes(Receiver& receiver) const;
  void add_vertex_echoes(Receiver& receiver) const;
  void add_ray(const Ray& ray, Receiver& receiver) const;
  void consider(const Point& target_m, double target_db, Receiver& receiver) const;

  EchoConfig config_;
  const Scene& scene_;
  double half_beam_rad_;
  double side_lobe_rad_;
  double far_side_lobe_rad_;
  double retro_cosine_;  // a bounced ray this straight on a mirror comes back
  std::vector<Ray> rays_;
};

}  // namespace cairn
