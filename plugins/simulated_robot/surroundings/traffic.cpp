#include "plugins/simulated_robot/surroundings/traffic.hpp"

#include <algorithm>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

constexpr double kClearOfLeaf_m = 0.01;
constexpr double kArrived_m = 1e-9;

World leaf_of(const WorldDoor& door) {
  World alone;
  alone.walls = {{{door.from_m, door.to_m}, door.surface}};
  return alone;
}

World outline_of(const WorldMover& mover) {
  World alone;
  alone.objects = {{"", mover.contour, {}, mover.surface}};
  return alone;
}

Pose2 shifted(const Pose2& pose, const Point& by_m) {
  return {pose.x_m + by_m.x(), pose.y_m + by_m.y(), pose.theta_rad};
}

std::string label(const std::string& kind, std::size_t index, const std::string& name) {
  return kind + " " + std::to_string(index + 1) + (name.empty() ? "" : " (" + name + ")");
}

}  // namespace

Traffic::Traffic(const World& world, const RobotModel& robot, const Pose2& T_map_start)
    : doors_(world.doors), movers_(world.movers), reach_m_(robot.radius_m) {
  for (const Point& corner : robot.polygon_m) reach_m_ = std::max(reach_m_, corner.norm());
  for (const WorldDoor& door : doors_) outlines_.emplace_back(leaf_of(door));
  for (const WorldMover& mover : movers_) outlines_.emplace_back(outline_of(mover));
  for (const Scene& outline : outlines_) footprints_.emplace_back(robot, outline);
  for (const WorldMover& mover : movers_) walks_.push_back({mover.path_m.front()});
  places_.resize(outlines_.size());
  advance(0.0, 0.0, T_map_start);
}

bool Traffic::is_clear_of(const WorldDoor& door, const Point& robot_m) const {
  return distance_to_segment_m(robot_m, door.from_m, door.to_m) >= reach_m_ + kClearOfLeaf_m;
}

void Traffic::advance(double time_s, double period_s, const Pose2& T_map_robot) {
  touches_ = false;
  for (std::size_t i = 0; i < doors_.size(); ++i) {
    if (!doors_[i].closes_at(time_s))
      places_[i].reset();
    else if (is_clear_of(doors_[i], T_map_robot.position()))
      places_[i] = Point(0.0, 0.0);
  }
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    walk(i, std::min(period_s, time_s - movers_[i].start_s), T_map_robot);
    places_[doors_.size() + i] = walks_[i].at_m;
  }
}

void Traffic::walk(std::size_t index, double for_s, const Pose2& T_map_robot) {
  const WorldMover& mover = movers_[index];
  Walk& walk = walks_[index];
  const Body& footprint = footprints_[doors_.size() + index];
  while (for_s > 0.0 && !walk.ended) {
    const double rest_s = std::min(walk.rest_s, for_s);
    walk.rest_s -= rest_s;
    for_s -= rest_s;
    const Point way_m = mover.path_m[walk.next] - walk.at_m;
    const double length_m = way_m.norm();
    if (length_m < kArrived_m) {
      arrive(mover, walk);
      continue;
    }
    const double step_m = std::min(length_m, mover.speed_mps * for_s);
    const Point step = way_m * (step_m / length_m);
    // As its outline sees it, the robot comes the other way.
    const double share = footprint.slide(shifted(T_map_robot, -walk.at_m), -step, mover.waits ? mover.keeps_m : 0.0);
    walk.at_m += share * step;
    for_s -= step_m / mover.speed_mps;
    if (share == 1.0) continue;
    touches_ |= !mover.waits;
    return;
  }
}

void Traffic::arrive(const WorldMover& mover, Walk& walk) {
  const std::size_t last = mover.path_m.size() - 1;
  walk.at_m = mover.path_m[walk.next];
  walk.rest_s = mover.pause_s;
  switch (mover.course) {
    case Course::once:
      walk.ended = walk.next == last;
      walk.next += walk.ended ? 0 : 1;
      break;
    case Course::round:
      walk.next = walk.next == last ? 0 : walk.next + 1;
      break;
    case Course::there_and_back:
      if (walk.next == (walk.back ? 0 : last)) walk.back = !walk.back;
      walk.next = walk.back ? walk.next - 1 : walk.next + 1;
      break;
  }
}

void Traffic::show(const Places& places, Scene& scene) const {
  scene.clear_moving();
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i]) scene.show(outlines_[i], *places[i], static_cast<int>(i));
}

std::optional<std::string> Traffic::blocker_at(const Pose2& T_map_robot) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (!places_[i]) continue;
    const Pose2 T_outline_robot = shifted(T_map_robot, -*places_[i]);
    const bool is_door = i < doors_.size();
    const std::size_t mover = i - doors_.size();
    const bool inside = !is_door && movers_[mover].contour.signed_distance(T_outline_robot.position()) < 0.0;
    if (!inside && footprints_[i].clearance_m(T_outline_robot) >= 0.0) continue;
    return is_door ? label("door", i, doors_[i].name) : label("mover", mover, movers_[mover].name);
  }
  return std::nullopt;
}

}  // namespace cairn
