// What a compass is worth, judged by its own readings: the robot's file may say too little of its noise and its bias.
#pragma once

namespace cairn::odometry_compass {

// White noise of single readings. The compass and the odometry turn by the same angle from one reading to the next but
// for twice the variance of a reading: neither the heading's own error nor a bias that changes slowly is in it. A
// running mean of these squares, cut off at three deviations so that a jump or a wheel that slips counts for one
// reading only. Never below what the file says.
class CompassNoise {
 public:
  // stated_rad above 0.
  explicit CompassNoise(double stated_rad);

  // How much more the compass has turned than the odometry since the last reading.
  void add(double turned_more_rad);
  [[nodiscard]] double deviation_rad() const;
  // Whether enough readings have been taken to know.
  [[nodiscard]] bool is_settled() const;

 private:
  double stated_rad_;
  double mean_square_;  // of the differences
  double readings_;     // that the mean stands for
};

// Running means of how far off readings are, in standard deviations of each: of the last half second, for what happens
// at once, and of some four seconds, for what creeps.
class CompassDrift {
 public:
  void add(double off_sigmas);
  void restart();
  // More than so many standard deviations of the mean itself.
  [[nodiscard]] bool is_fast(double sigmas) const;
  [[nodiscard]] bool is_slow(double sigmas) const;
  [[nodiscard]] double fast_sigmas() const { return fast_; }
  [[nodiscard]] double slow_sigmas() const { return slow_; }

  static constexpr double kFastShare = 0.15;  // of the newest reading in the mean: about 12 readings
  static constexpr double kSlowShare = 0.02;

 private:
  double fast_ = 0.0;
  double slow_ = 0.0;
};

}  // namespace cairn::odometry_compass
