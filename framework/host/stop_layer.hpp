// The stop layer: below every behaviour, it never lets the robot drive into what its sensors see.
//
// Keeps the last echo of each transducer as points on its arc, moved along with the odometry, and
// cuts the wanted speed so that the robot can always brake before the nearest point in its way.
#pragma once

#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn {

struct StopLayerConfig {
  double margin_m = 0.05;  // kept between the footprint and anything seen
  double stale_s = 1.0;    // an echo older than this no longer counts
  double blind_s = 1.0;    // without any reading for so long, no driving
  static void describe(Fields<StopLayerConfig>& fields);
};

class StopLayer {
 public:
  StopLayer(const StopLayerConfig& config, const RobotModel& robot);

  void see(const Observation& observation);
  // The wanted velocity, within the robot's limits and what the sensors allow.
  [[nodiscard]] Twist limit(const Twist& wanted) const;
  // Share of a wanted speed that an allowed one leaves out: 0 none, 1 all.
  [[nodiscard]] double held_back_ratio(const Twist& wanted, const Twist& allowed) const;

 private:
  struct Echo {
    double stamp_s = -1.0;
    std::vector<Point> points_odom;
  };
  [[nodiscard]] double free_way_m(const Twist& wanted) const;

  StopLayerConfig config_;
  RobotModel robot_;
  Pose2 T_odom_robot_;
  double stamp_s_ = 0.0;
  double last_reading_s_ = 0.0;
  std::vector<Echo> echoes_;  // by transducer
};

}  // namespace cairn
