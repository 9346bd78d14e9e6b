// Straight walls in the last metres' sonar echoes (Tardos et al. 2002: Hough votes of wide beams).
//
// An echo of a wide beam comes from the foot of the perpendicular on the wall, wherever in the beam that is: so
// echoes of one wall from several places have one line that all their circles touch. Each echo votes for the lines
// that it may come from; the winner is fitted by least squares, and counts when it was seen from places far enough
// apart. An echo serves one wall only. What comes from a point (a corner, a pole) fits a line for a while too: a
// point is fitted as well, and the line must fit better. Never allocates.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "plugins/odometry_compass/wall.hpp"

namespace cairn::odometry_compass {

struct WallFinderRules {
  double memory_m = 2.0;  // of driven way, during which echoes are kept
  double memory_s = 15.0;
  int min_echoes = 8;
  double min_span_m = 0.2;  // of the places it was seen from, along the wall
  double inlier_m = 0.05;
  double max_rms_m = 0.02;
  double range_noise_m = 0.015;  // of an echo's range, with what the odometry adds in between
  double heading_noise_rad_per_m = radians(2.0);
  double compass_noise_rad = 0.0;  // 0: there is none
  double max_range_m = 4.5;
};

class WallFinder {
 public:
  explicit WallFinder(const WallFinderRules& rules);

  // The standard deviation of a compass reading from now on; 0: it is not to be believed.
  void rate_compass(double noise_rad) { rules_.compass_noise_rad = noise_rad; }
  // Keeps the echoes of an observation. Its odometry must be finite.
  void take(const Observation& observation);
  // Whether enough new echoes have come for a search.
  [[nodiscard]] bool is_due() const;
  // What the echoes since the last search say of a wall that is known; those of which another one is nearer are that
  // one's. They are used up.
  [[nodiscard]] std::optional<SeenWall> look_for(const ExpectedWall& wall, std::span<const ExpectedWall> all);
  // The wall that most echoes speak for; its echoes are used up. Looks at all that are kept, whether or not it
  // is_due(): that is for the caller to ask.
  [[nodiscard]] std::optional<SeenWall> find();

 private:
  struct Echo {
    Point at_m{0.0, 0.0};  // of the transducer, by odometry
    double axis_rad = 0.0;
    double half_beam_rad = 0.0;
    double range_m = 0.0;
    double driven_m = 0.0;
    double stamp_s = 0.0;
  };
  struct Line {
    double normal_rad = 0.0;
    double distance_m = 0.0;  // from where the robot is now
  };
  struct Fit;
  struct Demands;

  void steady(const Pose2& step, const std::optional<double>& compass_rad);
  void forget_old();
  [[nodiscard]] bool count_votes();
  [[nodiscard]] std::optional<Line> strongest();
  [[nodiscard]] std::optional<Fit> fit(Line line, const Demands& demands) const;
  [[nodiscard]] bool speaks_for(const Echo& echo, const Line& line, double within_m) const;
  [[nodiscard]] std::optional<double> off_m(const Echo& echo, const ExpectedWall& wall) const;
  [[nodiscard]] double point_rms_m(const Line& line) const;
  [[nodiscard]] SeenWall seen(const Fit& fit) const;

  static constexpr int kMaxEchoes = 256;
  static constexpr int kDirections = 120;
  static constexpr int kDistances = 144;
  [[nodiscard]] static constexpr std::size_t vote_index(int direction, int distance) {
    return static_cast<std::size_t>(direction) * kDistances + static_cast<std::size_t>(distance);
  }

  WallFinderRules rules_;
  std::vector<Echo> echoes_;  // oldest first
  std::vector<std::uint16_t> votes_;
  Pose2 T_odom_last_;
  Pose2 T_odom_robot_;  // with the steadied heading
  double heading_variance_ = 1.0;
  bool begun_ = false;
  double driven_m_ = 0.0;
  double stamp_s_ = 0.0;
  int new_echoes_ = 0;
  std::vector<int> chosen_;  // of one look, indices of echoes
  std::vector<double> offs_m_;
};

}  // namespace cairn::odometry_compass
