// Localizer: odometry for the motion, compass for the heading, known walls and landmarks against the drift.
//
// Promises a covariance that is honest for the errors the robot's file states (docs/method.md 11): white and
// constant odometry errors, white compass noise, and a compass bias that wanders from place to place.
// The first observation's odometry is the reference; whatever it says is the start pose. Rules:
//   odometry that is not finite, or   the step is skipped, the next one counts from the last good one
//   beyond 1000 km
//   no compass, or not finite         odometry alone
//   compass that turns at once by     a disturbance: refused while it is beyond the gate, at most
//   what no wheel could turn          `compass_refused_at_most_s`
//   compass readings that scatter     their noise is estimated: at least what the file says
//   compass that parts from the       no wall or landmark has been met again yet: wheels slip, the heading is the
//   heading little by little          suspect; later: the compass's bias is the suspect before the heading, and walls
//                                     and landmarks decide
//   no compass in the robot's file    its readings are not used
//   landmark beyond the gate          refused (the wrong landmark, most likely)
//   landmark further than 1000 km     refused
// Walls come after the compass, landmarks after walls, printed markers last.
#pragma once

#include <optional>
#include <span>

#include "framework/contracts/localizer.hpp"
#include "framework/contracts/robot_model.hpp"
#include "plugins/odometry_compass/compass_trust.hpp"
#include "plugins/odometry_compass/config.hpp"
#include "plugins/odometry_compass/landmark_sightings.hpp"
#include "plugins/odometry_compass/marker_sightings.hpp"
#include "plugins/odometry_compass/pose_filter.hpp"
#include "plugins/odometry_compass/wall_finder.hpp"

namespace cairn::odometry_compass {

class OdometryCompass final : public Localizer {
 public:
  OdometryCompass(const Config& config, const RobotModel& robot, const Pose2& T_map_start,
                  std::span<const LandmarkShape> shapes = {}, const StartUncertainty& start = {});

  PoseEstimate update(const Observation& observation, const KnownMap& known) override;
  // The same with what has been seen again.
  PoseEstimate update_by(const Observation& observation, std::span<const LandmarkSighting> sightings);

 private:
  // The bias, since the compass has parted from the heading by so much.
  struct Suspect {
    double off_rad = 0.0;
    int witnesses = 0;  // that have spoken when it was suspected
  };
  static constexpr int kWitnesses = 3;
  void follow_odometry(const Pose2& T_odom_robot);
  void follow_compass(double compass_rad, double stamp_s);
  void follow_slip(double turned_rad);
  void suspect_bias(double off_rad);
  void judge_suspect();
  [[nodiscard]] bool has_jumped(double compass_rad) const;
  [[nodiscard]] double compass_noise_rad() const { return compass_noise_.deviation_rad(); }
  [[nodiscard]] bool has_witness() const { return witnesses_ >= kWitnesses; }
  [[nodiscard]] bool could_slip(double turned_rad) const;
  [[nodiscard]] std::span<const LandmarkSighting> see_again(const Observation& observation, const KnownMap& known);
  // before: without the markers.
  [[nodiscard]] PoseEstimate follow_markers(const Observation& observation, const KnownMap& known,
                                            const PoseEstimate& before);
  int follow_walls(const Observation& observation);
  bool follow_landmark(const LandmarkSighting& sighting);
  [[nodiscard]] bool correct_by(const LandmarkSighting& sighting);

  Config config_;
  MotionNoise motion_noise_;
  bool use_compass_;
  CompassNoise compass_noise_;
  double stated_bias_rad_;  // deviation of the compass's bias, as far as the robot's file knows
  double stated_max_bias_rad_;
  double max_bias_rad_;
  double about_half_track_m_;  // of a differential robot; 0: of another
  PoseFilter filter_;
  WallFinder wall_finder_;
  LandmarkSightings landmark_sightings_;
  MarkerSightings marker_sightings_;
  std::optional<Pose2> T_odom_robot_;      // the last good one
  Pose2 last_step_;                        // as odometry saw it
  std::optional<double> compass_rad_;      // the last reading
  double turned_rad_ = 0.0;                // since then, by odometry
  double rolled_m_ = 0.0;                  // since then, by the wheel that rolled more
  bool jumped_ = false;                    // the compass; nothing of it was within the gate since
  std::optional<double> refused_since_s_;  // the compass
  CompassDrift drift_;
  double rolled_in_all_m_ = 0.0;
  double drift_rolled_m_ = 0.0;  // rolled in that time, about
  int witnesses_ = 0;            // corrections by walls and landmarks
  std::optional<Suspect> suspect_;
  int refused_places_ = 0;  // sightings in a row that would all move the robot by about the same
  Point refused_off_m_{0.0, 0.0};
};

}  // namespace cairn::odometry_compass
