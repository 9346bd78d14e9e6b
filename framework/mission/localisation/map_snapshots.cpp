#include "framework/mission/localisation/map_snapshots.hpp"

namespace cairn {

bool MapSnapshots::drive(const Pose2& T_map_robot) {
  if (T_map_robot_) driven_m_ += (T_map_robot.position() - T_map_robot_->position()).norm();
  T_map_robot_ = T_map_robot;
  return kept_.empty() || driven_m_ >= kEvery_m;
}

void MapSnapshots::add(std::shared_ptr<const MapSnapshot> snapshot) {
  kept_.push_back(std::move(snapshot));
  if (kept_.size() > kKept) kept_.pop_front();
  driven_m_ = 0.0;
}

void MapSnapshots::clear() {
  kept_.clear();
  begin_distance();
}

void MapSnapshots::begin_distance() {
  T_map_robot_.reset();
  driven_m_ = 0.0;
}

}  // namespace cairn
