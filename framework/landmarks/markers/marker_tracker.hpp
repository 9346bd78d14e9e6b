// From sightings of printed markers to where they are. Which marker it is needs no guess: each has its number.
//
// A sighting's error is that of the picture and that of the robot's pose. Sightings from about the same place share the
// latter, so only those some way apart count, weighted by their information (inverse covariance). Where a picture
// leaves the two-fold ambiguity of a square open, both poses are followed until sightings from elsewhere have decided.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "framework/contracts/localizer.hpp"
#include "framework/contracts/marker.hpp"

namespace cairn {

// Whether two places of the robot are so far apart that sightings of a marker from them are two.
[[nodiscard]] bool are_apart(const Pose2& a, const Pose2& b);

class MarkerTracker {
 public:
  // Where a marker is, in the map.
  struct Estimate {
    Pose2 T_map_marker;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // x_m, y_m, theta_rad
    int sightings = 0;                                     // that count
    bool is_decided = true;                                // which of two poses it is
  };

  // Takes in the sightings of one observation; pose_number: of the robot's poses so far. The markers whose estimates
  // have changed. A number that is twice in one picture is no one marker, and left out.
  [[nodiscard]] std::vector<MarkerId> update(std::span<const MarkerSighting> sightings, const PoseEstimate& pose,
                                             std::size_t pose_number);
  // The robot's poses are known better: all estimates are made anew. Poses by their numbers.
  void correct(std::span<const Pose2> T_map_robot);

  [[nodiscard]] std::optional<Estimate> estimate(const MarkerId& marker) const;
  [[nodiscard]] std::vector<MarkerId> markers() const;

 private:
  struct Hypothesis {
    Eigen::Vector3d state;  // x_m, y_m, theta_rad
    Eigen::Matrix3d covariance;
    double misfit = 0.0;  // sum of squared Mahalanobis distances
  };
  struct Kept {
    MarkerSighting sighting;
    Pose2 T_map_robot;
    Eigen::Matrix3d pose_covariance;
    std::size_t pose_number = 0;
  };
  struct Track {
    std::vector<Hypothesis> hypotheses;  // one or two, the likelier first
    std::vector<Kept> kept;
    Eigen::Matrix3d min_pose_covariance = Eigen::Matrix3d::Zero();  // of the robot, when it saw it
    int strangers = 0;                                              // sightings in a row that are far off
  };

  struct Match {
    Eigen::Vector3d off;         // of the sighting from the hypothesis
    Eigen::Matrix3d covariance;  // of the sighting, in the map
    double distance2 = 0.0;      // squared Mahalanobis distance
  };

  static Match match_of(const Hypothesis& hypothesis, const Kept& kept);
  static void correct(Hypothesis& hypothesis, const Match& match);
  static bool add(Track& track, const Kept& kept);
  static void begin(Track& track, const Kept& kept);

  std::map<MarkerId, Track> tracks_;
};

}  // namespace cairn
