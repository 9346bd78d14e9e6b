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

// Adds every cell within so many cells of one that is in.
void widen(std::vector<Cell>& region, Neighbourhood& neighbourhood, int by) {
  const std::size_t grown = by > 0 ? region.size() : 0;
  for (std::size_t i = 0; i < grown; ++i) {
    for (int y = -by; y <= by; ++y) {
      for (int x = -by; x <= by; ++x) {
        const Cell c = region[i] + Cell{x, y};
        if (neighbourhood.insert(c)) region.push_back(c);
      }
    }
  }
}

}  // namespace

RegionReach RegionReach::of(double smallest_diameter_m, double largest_diameter_m, double coarse_cell_m) {
  const int start = floor_of(smallest_diameter_m / (2.0 * coarse_cell_m));
  return {start, std::max(start, floor_of(largest_diameter_m / coarse_cell_m))};
}

RegionReach RegionReach::of(const TemplateSet& set, double coarse_cell_m) {
  RegionReach reach = of(set.smallest_diameter_m(), set.largest_diameter_m(), coarse_cell_m);
  for (const LandmarkShape& shape : set.shapes) {
    const double open_m = shape.contour.signed_distance({0.0, 0.0});
    if (open_m > 0.0) reach.open = std::max(reach.open, static_cast<int>(std::ceil(open_m / coarse_cell_m)));
  }
  return reach;
}

std::vector<Cell> grow_region(const CoarseGrid& coarse, Cell trigger, const RegionReach& reach, double tau_grow) {
  Neighbourhood neighbourhood(trigger, reach.most + reach.open);
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
        if (distance8(c, trigger) > reach.most || !bounds.contains(c) || coarse.ol(c) <= tau_grow) continue;
        if (neighbourhood.insert(c)) region.push_back(c);
      }
    }
  }
  widen(region, neighbourhood, reach.open);
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
