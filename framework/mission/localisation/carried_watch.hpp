// Watches a robot that knows its place: keeps what its map was some metres ago, and says when its place is in doubt.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "framework/mission/localisation/map_snapshots.hpp"
#include "framework/mission/localisation/pose_doubt.hpp"
#include "framework/mission/localisation/watch_figures.hpp"

namespace cairn {

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
  // When the robot has found itself: all begins anew, and a doubt needs as little as at first.
  void begin_anew();
  // When a check has found nothing against its place: the map so far is forgotten, and later doubts need more.
  void doubt_was_wrong();
  // After a check that leaves it open: a doubt needs new evidence, but what the map was stays.
  void keep_map();

  void record(DoubtRecord doubt) { figures_.add(std::move(doubt)); }
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
