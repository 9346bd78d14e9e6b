// Localizer: odometry for the motion, compass for the heading, known walls and landmarks against the drift.
//
// A compass and wheels that part tell nobody which of them is wrong. So two trackers run side by side: one believes the
// robot's file, by which the compass has no local bias, and takes what parts for wheels that slip; the other one allows
// for a bias of `unstated_bias_deg`. Walls decide: the right tracker meets them again where it expects them. The map
// is drawn by the first until the second has clearly more evidence, or the other way round (multiple model estimation:
// Bar-Shalom, Li and Kirubarajan 2001, 11.6). Where the file states a bias, or there is no compass, one tracker is
// enough.
#pragma once

#include <optional>
#include <span>

#include "framework/contracts/localizer.hpp"
#include "plugins/odometry_compass/landmark_sightings.hpp"
#include "plugins/odometry_compass/marker_sightings.hpp"
#include "plugins/odometry_compass/pose_tracker.hpp"

namespace cairn::odometry_compass {

class OdometryCompass final : public Localizer {
 public:
  OdometryCompass(const Config& config, const RobotModel& robot, const Pose2& T_map_start,
                  std::span<const LandmarkShape> shapes = {}, const StartUncertainty& start = {});

  PoseEstimate update(const Observation& observation, const KnownMap& known) override;
  // The same with what has been seen again.
  PoseEstimate update_by(const Observation& observation, std::span<const LandmarkSighting> sightings);

 private:
  void begin_again();
  // before: without the markers.
  [[nodiscard]] PoseEstimate follow_markers(const Observation& observation, const KnownMap& known,
                                            const PoseEstimate& before);

  bool use_landmarks_;
  CompassBias chosen_bias_;
  CompassBias other_bias_;
  PoseTracker chosen_;
  std::optional<PoseTracker> other_;
  int wins_ = 0;  // of the chosen one, in a row; what has won often is not given up lightly
  LandmarkSightings landmark_sightings_;
  MarkerSightings marker_sightings_;
};

}  // namespace cairn::odometry_compass
