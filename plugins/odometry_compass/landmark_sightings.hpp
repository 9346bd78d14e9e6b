// Known landmarks seen again in fresh readings.
//
// Readings are kept with the odometry they were taken at. One belongs to the landmark whose outline it should have met
// first, if it is about as long as that says, nothing that the map holds stands in front and no other landmark is
// about as near. Once enough belong to a landmark, the pose that they fit best is solved for (align()), and with it
// where the landmark is from the robot. Each reading counts once, so that sightings are independent of each other.
//
// Landmarks count from where they were when they became known: their place is refined by later matchings in a map that
// has gone on with the robot's drift. It is followed only while the robot knows better where it is than it did then;
// what it did not know then is part of each sighting's covariance. Without an outline there are no sightings.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "framework/contracts/localizer.hpp"
#include "maps/geometry/contour.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "plugins/odometry_compass/range_alignment.hpp"

namespace cairn::odometry_compass {

// A known landmark seen again in fresh readings.
struct LandmarkSighting {
  LandmarkId landmark = 0;
  Pose2 T_map_landmark;    // as it was when it became known
  Pose2 T_robot_landmark;  // as just measured
  // Of T_robot_landmark: x_m, y_m, theta_rad. Large in the directions that the readings do not determine.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

class LandmarkSightings {
 public:
  explicit LandmarkSightings(std::vector<LandmarkShape> shapes) : shapes_(std::move(shapes)) {}
  // Anchors point to the shapes.
  LandmarkSightings(const LandmarkSightings&) = delete;
  LandmarkSightings& operator=(const LandmarkSightings&) = delete;

  // Takes in the readings of one observation and says what they and those before have shown. `pose` is that of the
  // observation before, whose odometry was T_odom_before. Valid until the next call.
  [[nodiscard]] std::span<const LandmarkSighting> look(const Observation& observation, const PoseEstimate& pose,
                                                       const Pose2& T_odom_before, const KnownMap& known);

 private:
  struct FreshReading {
    Pose2 T_odom_sensor;
    double half_beam_rad = 0.0;
    double range_m = 0.0;
    double stamp_s = 0.0;
    double driven_m = 0.0;
  };
  // A landmark where it was when it became known.
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
  void assign(const FreshReading& reading, const Scene& scene, const OccupancyGrid& grid);
  void find(LandmarkId id, Anchor& anchor, const Scene& scene);
  [[nodiscard]] double deviation_of(const FreshReading& reading) const;
  void report(LandmarkId id, const Anchor& anchor, const Scene& scene, const Alignment& found);

  std::vector<LandmarkShape> shapes_;
  std::map<LandmarkId, Anchor> anchors_;
  std::vector<FreshReading> window_;
  std::vector<LandmarkSighting> reported_;
  Pose2 T_odom_last_;
  bool begun_ = false;
  double driven_m_ = 0.0;
};

}  // namespace cairn::odometry_compass
