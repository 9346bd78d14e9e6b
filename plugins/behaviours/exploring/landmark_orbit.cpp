#include "plugins/behaviours/exploring/landmark_orbit.hpp"

#include <algorithm>
#include <span>

#include "plugins/behaviours/places/map_watch.hpp"

namespace cairn::behaviours {
namespace {

CellGroup object_at(const FreeSpace& space, const Point& centre, const InspectOrbitSettings& settings) {
  CellGroup best;
  double nearest_m = settings.is_landmark_m;
  for (CellGroup& object : compact_objects(space, settings.largest_object_m, settings.object)) {
    Point sum{0.0, 0.0};
    for (const Cell c : object) sum += space.centre_of(c);
    const double distance_m = (sum / static_cast<double>(object.size()) - centre).norm();
    if (distance_m > nearest_m) continue;
    nearest_m = distance_m;
    best = std::move(object);
  }
  if (!best.empty()) return best;
  const Cell middle = space.cell_at(centre);
  const int reach = settings.usual_outline_cells;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) best.push_back(middle + Cell{dx, dy});
  return best;
}

}  // namespace

void InspectOrbitSettings::describe(Fields<InspectOrbitSettings>& fields) {
  using C = InspectOrbitSettings;
  fields.number("near_m", &C::near_m, {0.1, 50.0}, "m", "an orbit begins when the robot is this near to the landmark");
  fields.number("around_m", &C::around_m, {0.5, 100.0}, "m", "the part of the map round both that is searched");
  fields.number("clearance_m", &C::clearance_m, {0.0, 5.0}, "m", "room that an orbit keeps beside the robot");
  fields.number("further_m", &C::further_m, {0.0, 5.0}, "m", "an orbit may lead further from the landmark by this");
  fields.number("largest_object_m", &C::largest_object_m, {0.1, 20.0}, "m", "what is longer is a wall");
  fields.number("is_landmark_m", &C::is_landmark_m, {0.0, 10.0}, "m",
                "the object this near to the landmark's place is the landmark");
  fields.integer("usual_outline_cells", &C::usual_outline_cells, {0.0, 1000.0},
                 "a landmark that the map does not show is taken to reach so far to each side");
  fields.number("choose_every_s", &C::choose_every_s, {0.1, 600.0}, "s", "the orbit's path is chosen anew this often");
  fields.number("trace_apart_m", &C::trace_apart_m, {0.01, 5.0}, "m",
                "where the robot was is remembered at this "
                "spacing");
  fields.integer("min_covered_sectors", &C::min_covered_sectors, {1.0, 24.0}, "fewer of 24 directions are no orbit");
  fields.number("arrived_m", &C::arrived_m, {0.001, 1.0}, "m", "this near to the end of an orbit's path is there");
  fields.number("avoid_ahead_m", &C::avoid_ahead_m, {0.0, 10.0}, "m",
                "where it was blocked, the orbit leaves out the place this far ahead");
  fields.number("back_up_mps", &C::back_up_mps, {0.001, 1.0}, "m/s", "then it backs up at this speed");
  fields.number("back_up_s", &C::back_up_s, {0.0, 600.0}, "s", "for so long");
  fields.number("behind_m", &C::behind_m, {0.01, 10.0}, "m", "while this much behind it is free");
  fields.group("object", &C::object, "what is an object that stands free");
}

void LandmarkOrbit::see(const WorldView& world) {
  const Pose2& pose = world.pose.T_map_robot;
  if (!near_echoes_) near_echoes_.emplace(world.grid, map_.echoes.near);
  if (world.observation != nullptr) near_echoes_->see(*world.observation, pose);
  near_echoes_->stand_at(pose.position(), world.robot.radius_m);
  if (trace_.empty() || (trace_.back().position() - pose.position()).norm() >= settings_.trace_apart_m)
    trace_.push_back(pose);
}

void LandmarkOrbit::begin_in_new_map(const MapMove* move) {
  near_echoes_.reset();
  if (move == nullptr) {
    trace_.clear();
    begin();
    return;
  }
  move_places(*move, trace_);
  move_places(*move, avoid_);
}

void LandmarkOrbit::begin() {
  begins_ = trace_.size();
  avoid_.clear();
}

std::vector<Point> LandmarkOrbit::path(const WorldView& world, const Point& centre) {
  const Pose2& pose = world.pose.T_map_robot;
  const Cell here = world.grid.cell_at(pose.position());
  const Cell there = world.grid.cell_at(centre);
  const int reach = static_cast<int>(settings_.around_m / world.grid.cell_m());
  const CellBox part = united(CellBox{here, here + Cell{1, 1}}, CellBox{there, there + Cell{1, 1}}).grown(reach);
  const FreeSpace space(near_echoes_->applied_to(world.grid, part),
                        {pose.position(), world.robot.radius_m, settings_.clearance_m, map_.paths}, trace_);
  const OrbitSettings wanted{distance_m_, distance_m_ + settings_.further_m, settings_.largest_object_m,
                             settings_.object};
  const auto of_orbit = std::span(trace_).subspan(std::min(begins_, trace_.size()));
  const Orbit orbit = orbit_round(space, object_at(space, centre, settings_), of_orbit, avoid_, wanted);
  covered_ = orbit.count(SectorState::covered);
  if (orbit.count(SectorState::open) == 0) return {};
  return orbit_route(space, orbit, pose).path;
}

}  // namespace cairn::behaviours
