// Follows the robot's pose under one belief of the compass's local bias: that there is none, or how large it may be.
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
//   compass that parts from the       without a bias: wheels slip, the heading is the suspect. With one: the heading
//   heading little by little          until walls or landmarks have been met again, then the bias before the heading,
//                                     and walls and landmarks decide
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
#include "plugins/odometry_compass/pose_filter.hpp"
#include "plugins/odometry_compass/wall_finder.hpp"

namespace cairn::odometry_compass {

// What is believed of the compass's local bias. Deviation 0: there is none.
struct CompassBias {
  double deviation_rad = 0.0;  // stationary
  double bound_rad = 0.0;
  static constexpr double kFar = 3.0;  // deviations, where nobody knows a bound
};

class PoseTracker {
 public:
  PoseTracker(const Config& config, const RobotModel& robot, const CompassBias& bias, const Pose2& T_map_start,
              const StartUncertainty& start = {});

  // sightings: landmarks seen again in the observation.
  PoseEstimate update(const Observation& observation, std::span<const LandmarkSighting> sightings);
  // More of them in the same observation; used and refused count these only.
  PoseEstimate correct(std::span<const LandmarkSighting> sightings);
  [[nodiscard]] PoseEstimate estimate() const { return filter_.estimate(); }
  // The odometry of the last observation whose odometry was usable.
  [[nodiscard]] const std::optional<Pose2>& T_odom_robot() const { return T_odom_robot_; }
  // Whether the compass has said from the beginning that the robot does not stand as it was told to, and no bias is
  // believed in.
  [[nodiscard]] bool starts_biased() const;
  // From now on. What was known of the bias is forgotten.
  void believe(const CompassBias& bias);
  // How often and how well walls were met where they were expected: sum of (gate squared - deviations squared) / 2 over
  // those that were met since the last restart and known before it; before the first, over all.
  [[nodiscard]] double wall_evidence() const { return wall_evidence_; }
  void restart_wall_evidence() {
    wall_evidence_ = 0.0;
    walls_that_count_ = filter_.walls();
  }

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
  void count_wall(int wall);
  int follow_walls(const Observation& observation);
  bool follow_landmark(const LandmarkSighting& sighting);
  [[nodiscard]] bool correct_by(const LandmarkSighting& sighting);

  Config config_;
  MotionNoise motion_noise_;
  bool use_compass_;
  CompassNoise compass_noise_;
  CompassBias bias_;
  double max_bias_rad_;
  double about_half_track_m_;  // of a differential robot; 0: of another
  PoseFilter filter_;
  WallFinder wall_finder_;
  double wall_evidence_ = 0.0;
  int walls_that_count_ = PoseFilter::kMaxWalls;
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
