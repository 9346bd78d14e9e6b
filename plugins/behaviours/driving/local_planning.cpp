#include "plugins/behaviours/driving/local_planning.hpp"

namespace cairn::behaviours {

void OptimismSettings::describe(Fields<OptimismSettings>& fields) {
  using C = OptimismSettings;
  fields.integer("max_escapes", &C::max_escapes, {0.0, 1000.0},
                 "how often the robot drives out of a place that is too near to something to plan from");
  fields.integer("max_unknown_paths", &C::max_unknown_paths, {0.0, 1000.0},
                 "how many paths on the local map may lead through unknown ground");
  fields.integer("max_narrow_gap_tries", &C::max_narrow_gap_tries, {0.0, 1000.0},
                 "how often an opening that looks too narrow is tried");
  fields.integer("looks_before_narrow_gaps", &C::looks_before_narrow_gaps, {0.0, 1000.0},
                 "that is tried after so many looks whether a blockage has gone");
  fields.number("narrow_gap_radius_m", &C::narrow_gap_radius_m, {0.01, 5.0}, "m",
                "an opening twice this wide is tried: sonars draw openings narrower than they are");
}

std::optional<LocalPath> LocalPlanning::path(const Point& goal, Optimism optimism, const WorldView& world,
                                             const LocalMap& map, const BlockageLook& look) const {
  const bool is_narrow = optimism == Optimism::narrow_gaps;
  for (const double wall_clearance_m : {map.settings().clearance_m, map.settings().tight_clearance_m}) {
    const double clearance_m = is_narrow ? settings_.narrow_gap_radius_m - world.robot.radius_m : wall_clearance_m;
    const FreeSpace space = map.space(world, clearance_m, optimism, goal, look.doubts());
    std::vector<Point> points = space.path_to(space.cell_at(goal));
    if (points.size() >= 2) {
      points.push_back(goal);
      return LocalPath{std::move(points), optimism};
    }
    if (is_narrow) break;
  }
  return std::nullopt;
}

std::optional<LocalPath> LocalPlanning::next_path(const Point& goal, const WorldView& world, const LocalMap& map,
                                                  const BlockageLook& look) {
  for (const Optimism optimism : {Optimism::none, Optimism::no_speckles, Optimism::unknown_free}) {
    if (optimism == Optimism::unknown_free && unknown_paths_ >= settings_.max_unknown_paths) continue;
    std::optional<LocalPath> found = path(goal, optimism, world, map, look);
    if (!found) continue;
    ++unknown_paths_;
    return found;
  }
  if (look.looks() < settings_.looks_before_narrow_gaps || narrow_gap_tries_ >= settings_.max_narrow_gap_tries)
    return std::nullopt;
  std::optional<LocalPath> found = path(goal, Optimism::narrow_gaps, world, map, look);
  if (found) ++narrow_gap_tries_;
  return found;
}

std::optional<std::vector<Point>> LocalPlanning::escape(const Point& goal, const WorldView& world, const LocalMap& map,
                                                        const BlockageLook& look) {
  if (escapes_ >= settings_.max_escapes) return std::nullopt;
  ++escapes_;
  for (const double clearance_m : {map.settings().escape_clearance_m, map.settings().tight_clearance_m}) {
    const FreeSpace space = map.space(world, clearance_m, Optimism::none, goal, look.doubts());
    if (space.escape_path().size() >= 2) return space.escape_path();
  }
  return std::nullopt;
}

}  // namespace cairn::behaviours
