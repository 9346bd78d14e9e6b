// Watches a robot that knows its place: keeps what its map was some metres ago, and says when its place is in doubt.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "framework/mission/localisation/map_snapshots.hpp"
#include "framework/mission/localisation/pose_doubt.hpp"
#include "maps/relocalisation/pose_check.hpp"

namespace cairn {

// A doubt of a mission under way, and what came of it.
struct DoubtRecord {
  double begun_s = 0.0;
  DoubtCause cause = DoubtCause::readings;
  PoseCheck check;
};
// A robot that was carried while its mission was under way.
struct CarriedRecord {
  double noticed_s = 0.0;
  double driven_m = 0.0;  // from the doubt until then
  std::optional<double> found_s;
  double searched_m = 0.0;  // driven from the doubt until it was found
  Pose2 T_map_robot;        // when it was found
};
struct WatchFigures {
  std::vector<DoubtRecord> doubts;  // the first of them
  std::size_t doubts_left_out = 0;
  std::vector<CarriedRecord> carried;
};

class CarriedWatch {
 public:
  explicit CarriedWatch(const RobotModel& robot) : doubt_(robot) {}

  using Landmarks = std::function<KnownLandmarks()>;
  // At every tick while the robot knows its place and no check is open, before the observation is drawn into the map.
  void update(const Observation& observation, const Pose2& T_map_robot, const OccupancyGrid& map,
              const Landmarks& landmarks);
  [[nodiscard]] const std::optional<DoubtCause>& doubt() const { return cause_; }
  // What the doubt is judged by, and what a robot that was carried goes back to. There is one when there is a doubt.
  [[nodiscard]] std::shared_ptr<const MapSnapshot> before() const { return snapshots_.oldest(); }
  // After a check, or when the robot has found itself: all begins anew.
  void begin_anew();

  void record(DoubtRecord doubt);
  void record_carried(const CarriedRecord& carried) { figures_.carried.push_back(carried); }
  void record_found(double time_s, double searched_m, const Pose2& T_map_robot);
  [[nodiscard]] const WatchFigures& figures() const { return figures_; }

 private:
  PoseDoubt doubt_;
  MapSnapshots snapshots_;
  std::optional<DoubtCause> cause_;
  WatchFigures figures_;
};

}  // namespace cairn
