#include "plugins/behaviours/exploring/known_share.hpp"

#include <algorithm>

namespace cairn::behaviours {
namespace {

// Of everything occupied; of the reach where nothing is.
CellBox outline_box(const FreeSpace& space, const CellLayer<char>& reach) {
  CellBox box;
  for (int y = space.box().min.y; y < space.box().max.y; ++y)
    for (int x = space.box().min.x; x < space.box().max.x; ++x)
      if (reach.at({x, y}) || space.state({x, y}) == CellState::occupied) box = united(box, {{x, y}, {x + 1, y + 1}});
  return box;
}

}  // namespace

void KnownShareSettings::describe(Fields<KnownShareSettings>& fields) {
  using C = KnownShareSettings;
  fields.number("every_s", &C::every_s, {0.1, 3600.0}, "s", "the map is counted this often");
  fields.number("rim_m", &C::rim_m, {0.0, 100.0}, "m",
                "unknown ground counts that may be reached within this of the box around everything occupied");
  fields.number("behind_m", &C::behind_m, {0.1, 100.0}, "m",
                "and within this of what is known, by path: a gap to the outside is no more than a room");
  fields.number("behind_edges_m", &C::behind_edges_m, {0.0, 100.0}, "m",
                "what may lie behind an edge that the robot has not been near to");
  fields.number("closed_radius_m", &C::closed_radius_m, {0.0, 10.0}, "m",
                "nothing lies behind what was looked at and found closed: within this of it");
  fields.integer("held_counts", &C::held_counts, {1.0, 1000.0}, "a rise counts once so many counts in a row have it");
}

void KnownShare::count(const FreeSpace& space, const CellLayer<char>& reach, std::size_t unseen_edges,
                       double gap_radius_m, double time_s, const std::vector<Point>& closed, double hidden_m2) {
  counted_s_ = time_s;
  const CellBox box = outline_box(space, reach).grown(static_cast<int>(settings_.rim_m / space.cell_m()));
  CellLayer<char> visited(box, 0, 1);
  CellGroup queue;
  const auto is_closed = [&](Cell c) {
    return std::ranges::any_of(
        closed, [&](const Point& p) { return (space.centre_of(c) - p).norm() < settings_.closed_radius_m; });
  };
  CellLayer<int> steps(box, 0, 0);  // from what is known
  const int max_steps = static_cast<int>(settings_.behind_m / space.cell_m());
  std::size_t known = 0;
  std::size_t unknown = 0;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (reach.at({x, y})) {
        visited[{x, y}] = 1;
        queue.push_back({x, y});
        ++known;
      }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    if (steps.at(queue[i]) >= max_steps) break;  // they rise
    for (const Cell step : kNeighbours) {
      const Cell next = queue[i] + step;
      if (visited.at(next) || space.state(next) == CellState::occupied) continue;
      const double room_m = space.box().contains(next) ? space.distance_m(next) : space.min_distance_m();
      if (room_m < gap_radius_m || is_closed(next)) continue;
      visited[next] = 1;
      steps[next] = steps.at(queue[i]) + 1;
      queue.push_back(next);
      unknown += room_m >= space.min_distance_m() ? 1 : 0;
    }
  }
  const double behind = static_cast<double>(unseen_edges) * settings_.behind_edges_m / space.cell_m();
  const double hidden = hidden_m2 / (space.cell_m() * space.cell_m());
  const double all = static_cast<double>(known + unknown) + behind + hidden;
  if (all <= 0.0) return;
  last_.push_back(static_cast<double>(known) / all);
  const auto held = static_cast<std::size_t>(settings_.held_counts);
  if (last_.size() > held) last_.erase(last_.begin());
  if (last_.size() == held) ratio_ = std::max(ratio_, *std::ranges::min_element(last_));
}

}  // namespace cairn::behaviours
