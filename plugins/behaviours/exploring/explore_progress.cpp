#include "plugins/behaviours/exploring/explore_progress.hpp"

#include <algorithm>
#include <cmath>

#include "plugins/behaviours/local_map/moved_cells.hpp"

namespace cairn::behaviours {
ExploreProgress::ExploreProgress(const WorldView& world, double near_m, const EstimateSettings& settings)
    : near_m_(near_m), settings_(settings), begun_s_(world.time_s), counted_s_(world.time_s) {}

void ExploreProgress::pass(const WorldView& world) {
  const Point here = world.pose.T_map_robot.position();
  if ((here - marked_m_).norm() < settings_.mark_every_m) return;
  marked_m_ = here;
  const double cell_m = world.grid.cell_m();
  const Cell centre = world.grid.cell_at(here);
  const int reach = static_cast<int>(near_m_ / cell_m);
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (dx * dx + dy * dy <= reach * reach) passed_.insert(centre + Cell{dx, dy});
}

double ExploreProgress::passed_ratio(const OccupancyGrid& grid) const {
  const CellBox box = grid.bounds();
  std::size_t all = 0;
  std::size_t passed = 0;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      if (grid.state({x, y}) != CellState::occupied) continue;
      ++all;
      passed += passed_.contains({x, y}) ? 1 : 0;
    }
  return all == 0 ? 0.0 : static_cast<double>(passed) / static_cast<double>(all);
}

std::optional<double> ExploreProgress::left_s(const WorldView& world) {
  if (const auto exchange = map_watch_.update(world))
    passed_ = exchange->move == nullptr ? CellSet() : moved_cells(*exchange->move, world.grid, passed_);
  pass(world);
  const double done_s = world.time_s - begun_s_;
  if (world.time_s >= counted_s_ + settings_.every_s) {
    counted_s_ = world.time_s;
    const double ratio = passed_ratio(world.grid);
    left_at_count_s_.reset();
    if (ratio > 0.0 && done_s >= settings_.not_before_s) left_at_count_s_ = done_s * (1.0 - ratio) / ratio;
  }
  if (!left_at_count_s_) return std::nullopt;
  return std::max(0.0, *left_at_count_s_ - (world.time_s - counted_s_));
}

}  // namespace cairn::behaviours
