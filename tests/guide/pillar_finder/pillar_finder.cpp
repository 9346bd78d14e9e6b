#include "pillar_finder.hpp"

#include <algorithm>
#include <numbers>
#include <set>

namespace pillar_finder {
namespace {

// The box of the occupied cells that hang together with this one. Empty when the cell is not occupied or
// belongs to a blob that is done, and when the blob is wider than `most` cells: that is a wall, and we
// need not follow it to its end.
cairn::CellBox blob_at(const cairn::OccupancyGrid& grid, cairn::Cell first, int most, std::set<cairn::Cell>& done) {
  if (done.contains(first)) return {};
  cairn::CellBox box;
  std::set<cairn::Cell> blob;
  std::vector<cairn::Cell> open{first};
  while (!open.empty()) {
    const cairn::Cell cell = open.back();
    open.pop_back();
    if (grid.state(cell) != cairn::CellState::occupied || !blob.insert(cell).second) continue;
    box = cairn::united(box, {cell, cell + cairn::Cell{1, 1}});
    if (std::max(box.width(), box.height()) > most) return {};
    for (int i = 0; i < 9; ++i) open.push_back(cell + cairn::Cell{i % 3 - 1, i / 3 - 1});
  }
  done.insert(blob.begin(), blob.end());
  return box;
}

}  // namespace

void Config::describe(cairn::Fields<Config>& fields) {
  fields.number("diameter_m", &Config::diameter_m, {0.05, 5.0}, "m", "how wide a pillar is");
  fields.number("tolerance_m", &Config::tolerance_m, {0.0, 1.0}, "m",
                "how much wider or narrower it may be in the map: sonars blur outlines");
  fields.number("tau_match", &Config::tau_match, {0.0, 1.0}, "", "a blob is a pillar when its degree is above this");
  fields.text("category", &Config::category, "what the landmarks are called");
}

cairn::DetectionReport PillarFinder::detect(const cairn::OccupancyGrid& grid, const cairn::CellChanges& changes,
                                            const cairn::Budget& budget) {
  cairn::DetectionReport report;
  const int most = static_cast<int>((config_.diameter_m + config_.tolerance_m) / grid.cell_m());
  std::set<cairn::Cell> done;
  for (const cairn::CellSpan& span : changes.spans) {
    // Beyond its bounds the grid holds nothing.
    const cairn::CellBox inside = cairn::intersected({{span.x_begin, span.y}, {span.x_end, span.y + 1}}, grid.bounds());
    for (int x = inside.min.x; x < inside.max.x; ++x) {
      if (budget.exhausted() || std::ssize(report.matchings) >= budget.iterations) return report;
      const cairn::CellBox blob = blob_at(grid, {x, span.y}, most, done);
      if (has_right_size(blob, grid.cell_m())) report.matchings.push_back(matching_of(grid, blob));
    }
  }
  return report;
}

bool PillarFinder::has_right_size(const cairn::CellBox& blob, double cell_m) const {
  const auto [shorter, longer] = std::minmax({blob.width(), blob.height()});
  return !blob.empty() && shorter * cell_m >= config_.diameter_m - config_.tolerance_m &&
         longer * cell_m <= config_.diameter_m + config_.tolerance_m;
}

// How like a pillar the map is around a place: the mean of how much of the rim is occupied and how much of
// the ground around it is free. What is within cannot be seen and does not count.
double PillarFinder::degree_at(const cairn::OccupancyGrid& grid, const cairn::Point& centre_m) const {
  const double radius_m = config_.diameter_m / 2.0;
  const double around_m = radius_m + config_.tolerance_m / 2.0;
  int directions = 0;
  int occupied = 0;
  int free = 0;
  for (double angle_rad = 0.0; angle_rad < 2.0 * std::numbers::pi; angle_rad += cairn::radians(10.0)) {
    const cairn::Point direction = cairn::Pose2{0.0, 0.0, angle_rad}.direction();
    const cairn::Point rim_m = centre_m + radius_m * direction;
    const cairn::Point ground_m = centre_m + (around_m + grid.cell_m()) * direction;
    ++directions;
    if (grid.state(grid.cell_at(rim_m)) == cairn::CellState::occupied) ++occupied;
    if (grid.state(grid.cell_at(ground_m)) == cairn::CellState::free) ++free;
  }
  return (occupied + free) / (2.0 * directions);
}

cairn::Matching PillarFinder::matching_of(const cairn::OccupancyGrid& grid, const cairn::CellBox& blob) const {
  const cairn::Point centre_m = (grid.centre_of(blob.min) + grid.centre_of(blob.max - cairn::Cell{1, 1})) / 2.0;
  const double degree = degree_at(grid, centre_m);
  cairn::Matching matching;
  matching.trigger = blob.min;
  matching.region_cells = blob.width() * blob.height();
  matching.region_centre_m = centre_m;
  matching.degrees = {{config_.category, degree, 0.0, centre_m}};
  if (degree > config_.tau_match) {
    matching.detection = cairn::Detection{
        config_.category, {centre_m.x(), centre_m.y(), 0.0}, degree, {{config_.category, 0.0, degree}}};
  }
  return matching;
}

}  // namespace pillar_finder
