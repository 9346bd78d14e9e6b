#include "framework/mission/localisation/carried_watch.hpp"

namespace cairn {

// What is drawn while much contradicts the map may be in the wrong place.
void CarriedWatch::update(const Observation& observation, const Pose2& T_map_robot, const OccupancyGrid& map,
                          const Landmarks& landmarks) {
  const bool is_due = snapshots_.drive(T_map_robot);
  if (map.bytes() > MapSnapshots::kMaxBytes)
    snapshots_.clear();
  else if (is_due && doubt_.is_quiet())
    snapshots_.add(std::make_shared<const MapSnapshot>(MapSnapshot{map, landmarks(), T_map_robot}));
  if (const auto before = snapshots_.oldest()) cause_ = doubt_.update(observation, T_map_robot, before->grid);
}

void CarriedWatch::begin_anew() {
  doubt_.forget_wrong();
  keep_map();
  snapshots_.clear();
}

void CarriedWatch::doubt_was_wrong() {
  if (cause_ == DoubtCause::readings) doubt_.was_wrong();
  keep_map();
  snapshots_.clear();
}

void CarriedWatch::keep_map() {
  doubt_.reset();
  snapshots_.begin_distance();
  cause_.reset();
}

void CarriedWatch::record_found(double time_s, double searched_m, const Pose2& T_map_robot) {
  CarriedRecord& last = figures_.carried.back();
  last.found_s = time_s;
  last.searched_m = searched_m;
  last.T_map_robot = T_map_robot;
}

}  // namespace cairn
