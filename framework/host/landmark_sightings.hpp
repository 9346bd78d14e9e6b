// Fresh readings against what is known: landmarks seen again, and walls of the map.
#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/localizer.hpp"
#include "framework/host/anchor_map.hpp"
#include "framework/host/range_alignment.hpp"
#include "maps/contour.hpp"

namespace cairn {

// A mission's `correct_pose`.
struct CorrectPoseConfig {
  bool by_landmarks = true;
  bool by_map = true;
  static void describe(Fields<CorrectPoseConfig>& fields);
};

class LandmarkSightings {
 public:
  LandmarkSightings(const CorrectPoseConfig& config, std::vector<LandmarkShape> shapes);

  // What earlier runs have left counts from the beginning.
  void go_on_from(const OccupancyGrid& grid);
  // Takes in the readings of one observation and says what they have shown, if there are enough of them by now. pose
  // is that of the observation before, whose odometry is T_odom_last. Each reading counts once. Valid until the next
  // call.
  [[nodiscard]] std::span<const LandmarkSighting> look(const Observation& observation, const PoseEstimate& pose,
                                                       const Pose2& T_odom_last, const LandmarkGraph& graph,
                                                       const OccupancyGrid& grid, double time_s);

 private:
  struct FreshReading {
    Pose2 T_odom_sensor;
    double half_beam_rad = 0.0;
    double range_m = 0.0;
    double stamp_s = 0.0;
    double driven_m = 0.0;
  };
  // A landmark where it was when it was confirmed, which is where its readings are compared with.
  struct Anchor {
    Pose2 T_map_landmark;
    std::string category;
    double variance_m2 = 0.0;
    const Contour* contour = nullptr;  // null: of a category without one
    std::vector<FreshReading> readings;
  };
  struct Scene;

  void take(const Observation& observation);
  void anchor_landmarks(const LandmarkGraph& graph, const PoseEstimate& pose);
  void assign(const FreshReading& reading, const Scene& scene, std::vector<FreshReading>& walls);
  void find_by_landmark(LandmarkId id, Anchor& anchor, const Scene& scene);
  void find_by_walls(const std::vector<FreshReading>& walls, const Scene& scene);
  [[nodiscard]] double deviation_of(const FreshReading& reading) const;
  void tell(LandmarkId id, const Pose2& T_map_landmark, double variance_m2, const Scene& scene,
            const Alignment& found);

  CorrectPoseConfig config_;
  std::vector<LandmarkShape> shapes_;
  AnchorMap anchor_map_;
  std::map<LandmarkId, Anchor> anchors_;
  std::vector<FreshReading> window_;
  std::vector<LandmarkSighting> told_;
  Pose2 T_odom_before_;
  bool begun_ = false;
  double driven_m_ = 0.0;
  double window_begin_m_ = 0.0;
  double window_begin_s_ = 0.0;
  double last_follow_s_ = -1e9;
};

}  // namespace cairn
