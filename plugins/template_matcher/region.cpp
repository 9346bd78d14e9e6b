#include "plugins/template_matcher/region.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::template_matcher {
namespace {

// Diameters are often whole multiples of the cells; 0.7 / 0.35 must count as 2.
int floor_of(double ratio) {
  return static_cast<int>(std::floor(ratio + 1e-9));
}

// A square of flags about the trigger cell.
class Neighbourhood {
 public:
  Neighbourhood(Cell centre, int reach)
      : centre_(centre), reach_(reach), side_(static_cast<std::size_t>(2 * reach + 1)), in_(side_ * side_, 0) {}

  [[nodiscard]] bool covers(Cell c) const { return distance8(c, centre_) <= reach_; }
  // True when the cell was not in yet.
  bool insert(Cell c) {
    char& flag = in_[static_cast<std::size_t>(c.y - centre_.y + reach_) * side_ +
                     static_cast<std::size_t>(c.x - centre_.x + reach_)];
    const bool is_new = flag == 0;
    flag = 1;
    return is_new;
  }

 private:
  Cell centre_;
  int reach_;
  std::size_t side_;
  std::vector<char> in_;
};

bool by_row(Cell a, Cell b) {
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

}  // namespace

RegionReach RegionReach::of(double smallest_diameter_m, double largest_diameter_m, double coarse_cell_m) {
  const int start = floor_of(smallest_diameter_m / (2.0 * coarse_cell_m));
  return {start, std::max(start, floor_of(largest_diameter_m / coarse_cell_m))};
}

std::vector<Cell> grow_region(const CoarseGrid& coarse, Cell trigger, const RegionReach& reach, double tau_grow) {
  Neighbourhood neighbourhood(trigger, reach.most);
  std::vector<Cell> region;
  for (int y = -reach.start; y <= reach.start; ++y) {
    for (int x = -reach.start; x <= reach.start; ++x) {
      region.push_back(trigger + Cell{x, y});
      neighbourhood.insert(region.back());
    }
  }
  const CellBox bounds = coarse.bounds();
  for (std::size_t next = 0; next < region.size(); ++next) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const Cell c = region[next] + Cell{x, y};
        if (!neighbourhood.covers(c) || !bounds.contains(c) || coarse.ol(c) <= tau_grow) continue;
        if (neighbourhood.insert(c)) region.push_back(c);
      }
    }
  }
  std::sort(region.begin(), region.end(), by_row);
  return region;
}

std::vector<CellSpan> fine_spans(const CoarseGrid& coarse, const std::vector<Cell>& region) {
  std::vector<CellSpan> spans;
  for (const Cell c : region) {
    const CellBox box = coarse.fine_box(c);
    for (int y = box.min.y; y < box.max.y; ++y) spans.push_back({y, box.min.x, box.max.x});
  }
  std::sort(spans.begin(), spans.end(),
            [](const CellSpan& a, const CellSpan& b) { return a.y != b.y ? a.y < b.y : a.x_begin < b.x_begin; });
  std::vector<CellSpan> joined;
  for (const CellSpan& span : spans) {
    if (!joined.empty() && joined.back().y == span.y && joined.back().x_end == span.x_begin) {
      joined.back().x_end = span.x_end;
    } else {
      joined.push_back(span);
    }
  }
  return joined;
}

}  // namespace cairn::template_matcher
