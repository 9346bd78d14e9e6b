#include "framework/experiments/buildings/building.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/planning/clusters_config.hpp"
#include "maps/base/portable_random.hpp"
#include "maps/geometry/segments.hpp"
#include "maps/grid/swept_disc.hpp"
#include "maps/hierarchy/hierarchy.hpp"

namespace cairn {
namespace {

constexpr double kRowPitch_m = 20.0;     // from corridor to corridor
constexpr double kColumnPitch_m = 50.0;  // the same for those across
constexpr double kHalfCorridor_m = 1.2;
constexpr double kWall_m = 0.15;
constexpr double kDoor_m = 1.1;
constexpr double kInside_m = 1.5;  // a landmark inside a door
constexpr double kClosed_ratio = 0.12;
constexpr double kSideDoor_ratio = 0.3;
constexpr LogOdds kFree = -900;
constexpr LogOdds kOccupied = 900;

enum Purpose : std::uint64_t { kRooms = 1, kClosing, kLandmarks, kPlaces };

struct Span {
  double low = 0.0;
  double high = 0.0;
};

struct Door {
  int row = 0;  // of its corridor
  double x_m = 0.0;
  double side = 1.0;  // of the corridor on which the room lies
};

class Plan {
 public:
  explicit Plan(const BuildingRules& rules)
      : rules_(rules),
        rows_(std::max(1, static_cast<int>(rules.side_m / kRowPitch_m))),
        columns_(std::max(1, static_cast<int>(rules.side_m / kColumnPitch_m))) {
    map_.grid = OccupancyGrid(rules.cell_m);
    map_.properties["robot_radius_m"] = std::to_string(rules.radius_m);
  }

  SavedMap made() {
    fill({0.0, 0.0}, {rules_.side_m, rules_.side_m}, kOccupied);
    for (int row = 0; row < rows_; ++row)
      fill({kWall_m, y_of(row) - kHalfCorridor_m}, {rules_.side_m - kWall_m, y_of(row) + kHalfCorridor_m}, kFree);
    for (int column = 0; column < columns_; ++column)
      fill({x_of(column) - kHalfCorridor_m, kWall_m}, {x_of(column) + kHalfCorridor_m, rules_.side_m - kWall_m}, kFree);
    build_rooms();
    close_corridors();
    place_landmarks();
    form_clusters();
    return std::move(map_);
  }

 private:
  [[nodiscard]] static double y_of(int row) { return (row + 0.5) * kRowPitch_m; }
  [[nodiscard]] static double x_of(int column) { return (column + 0.5) * kColumnPitch_m; }
  [[nodiscard]] int crossing(int column, int row) const { return row * columns_ + column; }

  void fill(const Point& low, const Point& high, LogOdds value) {
    const auto index = [&](double at_m) { return static_cast<int>(std::lround(at_m / rules_.cell_m)); };
    for (int y = index(low.y()); y < index(high.y()); ++y)
      for (int x = index(low.x()); x < index(high.x()); ++x) map_.grid.set_log_odds({x, y}, value);
  }

  // Between the corridors across.
  [[nodiscard]] std::vector<Span> spans() const {
    std::vector<Span> spans;
    double low = kWall_m;
    for (int column = 0; column < columns_; ++column) {
      spans.push_back({low, x_of(column) - kHalfCorridor_m - kWall_m});
      low = x_of(column) + kHalfCorridor_m + kWall_m;
    }
    spans.push_back({low, rules_.side_m - kWall_m});
    return spans;
  }

  void build_rooms() {
    PortableRandom random(rules_.seed, kRooms);
    for (int row = 0; row < rows_; ++row)
      for (const double side : {-1.0, 1.0})
        for (const Span& span : spans()) build_row_of_rooms(row, side, span, random);
  }

  void build_row_of_rooms(int row, double side, const Span& span, PortableRandom& random) {
    const double near_m = kHalfCorridor_m + kWall_m;
    const double far_m = 0.5 * kRowPitch_m - 0.5 * kWall_m;
    const auto at_y = [&](double off_m) { return y_of(row) + side * off_m; };
    const auto box = [&](double x_low, double x_high, double off_a_m, double off_b_m, LogOdds value) {
      const Span across = side > 0.0 ? Span{at_y(off_a_m), at_y(off_b_m)} : Span{at_y(off_b_m), at_y(off_a_m)};
      fill({x_low, across.low}, {x_high, across.high}, value);
    };
    for (double x = span.low; span.high - x >= 4.0;) {
      double width_m = random.between(4.0, 9.0);
      if (span.high - x - width_m < 4.0) width_m = span.high - x;
      box(x, x + width_m - kWall_m, near_m, far_m, kFree);
      const Door door{row, x + random.between(1.0, width_m - 1.0 - kWall_m), side};
      box(door.x_m - 0.5 * kDoor_m, door.x_m + 0.5 * kDoor_m, kHalfCorridor_m, near_m, kFree);
      if (random.share() < kSideDoor_ratio && x + width_m < span.high) {
        const double off_m = random.between(near_m + 0.3, near_m + 1.0);
        box(x + width_m - kWall_m, x + width_m, off_m, off_m + kDoor_m, kFree);
      }
      for (int pieces = random.whole(0, 4); pieces > 0; --pieces) {  // behind where one comes in
        const double left = random.between(x + 0.3, x + width_m - 1.5);
        const double off_m = random.between(near_m + kInside_m + 1.0, far_m - 1.0);
        box(left, left + random.between(0.4, 1.2), off_m, off_m + random.between(0.4, 0.9), kOccupied);
      }
      doors_.push_back(door);
      x += width_m;
    }
  }

  // A wall across some stretches from crossing to crossing, as long as others join these.
  void close_corridors() {
    PortableRandom random(rules_.seed, kClosing);
    struct Stretch {
      int a, b;
      Point from, to;
    };
    std::vector<Stretch> stretches;
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        const Point at(x_of(column), y_of(row));
        if (column + 1 < columns_)
          stretches.push_back({crossing(column, row), crossing(column + 1, row), at, {x_of(column + 1), y_of(row)}});
        if (row + 1 < rows_)
          stretches.push_back({crossing(column, row), crossing(column, row + 1), at, {x_of(column), y_of(row + 1)}});
      }
    std::vector<bool> closed(stretches.size(), false);
    const auto all_joined = [&] {
      std::vector<int> group(static_cast<std::size_t>(rows_ * columns_));
      std::iota(group.begin(), group.end(), 0);
      const auto root = [&](int i) {
        while (group[static_cast<std::size_t>(i)] != i) i = group[static_cast<std::size_t>(i)];
        return i;
      };
      for (std::size_t i = 0; i < stretches.size(); ++i)
        if (!closed[i]) group[static_cast<std::size_t>(root(stretches[i].a))] = root(stretches[i].b);
      for (int i = 1; i < rows_ * columns_; ++i)
        if (root(i) != root(0)) return false;
      return true;
    };
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const double share = random.between(0.2, 0.8);
      if (random.share() >= kClosed_ratio) continue;
      closed[i] = true;
      if (!all_joined()) {
        closed[i] = false;
        continue;
      }
      const Point at = stretches[i].from + share * (stretches[i].to - stretches[i].from);
      const bool across = stretches[i].from.y() == stretches[i].to.y();
      const Point half = across ? Point(0.5 * kWall_m, kHalfCorridor_m) : Point(kHalfCorridor_m, 0.5 * kWall_m);
      fill(at - half, at + half, kOccupied);
    }
  }

  LandmarkId add_landmark(const std::string& category, const Point& at) {
    Landmark landmark;
    landmark.category = category;
    landmark.T_map_landmark = {at.x(), at.y(), 0.0};
    landmark.access = landmark.T_map_landmark;
    landmark.degree = 0.7;
    landmark.sightings = 3;
    return map_.graph.add(landmark);
  }

  // Both ways, when nothing stands in between.
  void join(LandmarkId a, LandmarkId b, std::vector<Point> points) {
    for (std::size_t i = 1; i < points.size(); ++i)
      if (!sweep_is_free(map_.grid, {}, points[i - 1], points[i], rules_.radius_m + 0.05)) return;
    for (const bool back : {false, true}) {
      Route route;
      route.from = back ? b : a;
      route.to = back ? a : b;
      if (back) std::reverse(points.begin(), points.end());
      for (const Point& p : points) route.trajectory.push_back({p.x(), p.y(), 0.0});
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Point step = i + 1 < points.size() ? Point(points[i + 1] - points[i]) : Point(points[i] - points[i - 1]);
        route.trajectory[i].theta_rad = wrap_angle(std::atan2(step.y(), step.x()));
      }
      route.trajectory = in_whole_steps(route.trajectory);
      route.cost_m = length_of(route.trajectory);
      map_.graph.add_route(route);
    }
  }

  void place_landmarks() {
    std::vector<LandmarkId> at_crossing;
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column)
        at_crossing.push_back(add_landmark("crossing", {x_of(column), y_of(row)}));
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        const auto here = static_cast<std::size_t>(crossing(column, row));
        const Point at(x_of(column), y_of(row));
        if (column + 1 < columns_) join(at_crossing[here], at_crossing[here + 1], {at, {x_of(column + 1), at.y()}});
        if (row + 1 < rows_)
          join(at_crossing[here], at_crossing[here + static_cast<std::size_t>(columns_)],
               {at, {at.x(), y_of(row + 1)}});
      }
    place_at_doors(at_crossing);
  }

  void place_at_doors(const std::vector<LandmarkId>& at_crossing) {
    PortableRandom random(rules_.seed, kLandmarks);
    for (std::size_t i = doors_.size(); i > 1; --i)
      std::swap(doors_[i - 1], doors_[static_cast<std::size_t>(random.whole(0, static_cast<int>(i) - 1))]);
    const int wanted = std::max(0, rules_.landmarks - static_cast<int>(at_crossing.size()));
    doors_.resize(std::min(doors_.size(), static_cast<std::size_t>(wanted)));
    std::sort(doors_.begin(), doors_.end(), [](const Door& a, const Door& b) {
      return std::tie(a.row, a.x_m, a.side) < std::tie(b.row, b.x_m, b.side);
    });
    std::optional<std::pair<Door, LandmarkId>> before;
    for (const Door& door : doors_) {
      const Point foot(door.x_m, y_of(door.row));
      const Point inside = foot + Point(0.0, door.side * (kHalfCorridor_m + kWall_m + kInside_m));
      const LandmarkId id = add_landmark("door", inside);
      const int right = static_cast<int>(std::lround(door.x_m / kColumnPitch_m));  // the next crossing
      for (const int column : {right - 1, right})
        if (column >= 0 && column < columns_)
          join(id, at_crossing[static_cast<std::size_t>(crossing(column, door.row))],
               {inside, foot, {x_of(column), foot.y()}});
      if (before && before->first.row == door.row && door.x_m - before->first.x_m > 0.1 &&
          door.x_m - before->first.x_m < kColumnPitch_m) {
        const Point foot_before(before->first.x_m, foot.y());
        const Point in_before = map_.graph.find(before->second)->T_map_landmark.position();
        join(before->second, id, {in_before, foot_before, foot, inside});
      }
      before = {door, id};
    }
  }

  // As a mission saves them.
  void form_clusters() {
    const ClusterSizes sizes = ClustersConfig{}.sizes();
    map_.clusters =
        cluster_landmarks(map_.graph, {}, {sizes, passages_in(map_.grid, map_.graph, sizes.narrow_below_m)});
  }

  const BuildingRules& rules_;
  int rows_;
  int columns_;
  SavedMap map_;
  std::vector<Door> doors_;
};

}  // namespace

SavedMap building(const BuildingRules& rules) {
  return Plan(rules).made();
}

std::vector<std::pair<Point, Point>> random_pairs(const OccupancyGrid& grid, double radius_m, int count,
                                                  std::uint64_t seed) {
  PortableRandom random(seed, kPlaces);
  const CellBox box = grid.bounds();
  const auto place = [&] {
    for (;;) {
      const double x = random.between(box.min.x, box.max.x);
      const double y = random.between(box.min.y, box.max.y);
      const Point at = grid.origin_m() + grid.cell_m() * Point(x, y);
      // To the millimetre, as a question says it.
      Point rounded = (at * 1e3).array().round().matrix() / 1e3;
      if (sweep_is_free(grid, {}, rounded, rounded, radius_m + 0.01)) return rounded;
    }
  };
  std::vector<std::pair<Point, Point>> pairs;
  for (int i = 0; i < count; ++i) {
    const Point from = place();
    pairs.emplace_back(from, place());
  }
  return pairs;
}

}  // namespace cairn
