#include "plugins/behaviours/lookouts/passages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace cairn::behaviours {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr LogOdds kSeenThrough = -60;  // of what says which cells echoes have passed
constexpr double kThroughWall = 8.0;   // what a metre of wall costs, against one that is open

// The cheapest steps from what is in reach to every cell beyond it.
struct Beyond {
  CellLayer<float> cost_m;
  CellLayer<std::int8_t> came_from;
};

bool is_at_any(const Point& p, const std::vector<Point>& places, double within_m) {
  return std::ranges::any_of(places, [&](const Point& place) { return (place - p).norm() < within_m; });
}

class PassageFinder {
 public:
  PassageFinder(const FreeSpace& space, const OccupancyGrid& grid, const CellLayer<char>& reach, const Point& robot,
                const PassageSearch& search, const PassageSettings& settings)
      : space_(space), grid_(grid), reach_(reach), robot_(robot), search_(search), settings_(settings) {}

  [[nodiscard]] std::optional<Passage> nearest() {
    spread();
    std::optional<Passage> best;
    double best_m = kInfinite;
    for (const CellGroup& place : places_beyond()) {
      const std::optional<Passage> passage = passage_to(place);
      if (!passage || is_at_any(passage->at_m, search_.without, settings_.same_m)) continue;
      const double path_m = space_.cost_m(passage->lookout);
      const double far_m = (space_.centre_of(passage->lookout) - robot_).norm();
      const double missing_m = std::max(0.0, 2.0 * space_.min_distance_m() - passage->width_m);
      const double cost_m = (path_m < kInfinite ? path_m : kFar_m + far_m) + settings_.narrow_cost * missing_m +
                            (search_.through_walls ? suspicion_cost_m(*passage) : 0.0);
      if (cost_m >= best_m) continue;
      best = passage;
      best_m = cost_m;
    }
    return best;
  }

  [[nodiscard]] double seen_behind_walls_m2() {
    spread();
    double all_m2 = 0.0;
    for (const CellGroup& place : places_beyond()) all_m2 += area_m2(place);
    return all_m2;
  }

 private:
  static constexpr double kFar_m = 1e3;

  // Less where much was seen behind, more for each look beside it: one room would have all of its wall looked at.
  [[nodiscard]] double suspicion_cost_m(const Passage& passage) const {
    const auto beside = std::ranges::count_if(
        search_.without, [&](const Point& p) { return (p - passage.at_m).norm() < settings_.beside_m; });
    return settings_.look_beside_m * static_cast<double>(beside) -
           settings_.seen_bonus_m_per_m2 * std::min(passage.behind_m2, settings_.max_seen_m2);
  }
  [[nodiscard]] double area_m2(const CellGroup& place) const {
    return static_cast<double>(place.size()) * space_.cell_m() * space_.cell_m();
  }

  // Beyond the map's rim everything is unknown.
  [[nodiscard]] double room_m(Cell cell) const {
    const CellBox box = space_.box();
    if (box.contains(cell)) return space_.distance_m(cell);
    const Cell inside{std::clamp(cell.x, box.min.x, box.max.x - 1), std::clamp(cell.y, box.min.y, box.max.y - 1)};
    return space_.distance_m(inside) + space_.cell_m() * std::hypot(cell.x - inside.x, cell.y - inside.y);
  }

  // What a metre costs; infinite: cannot be crossed.
  [[nodiscard]] double price(Cell cell) const {
    if (closed_.at(cell)) return kInfinite;
    const bool is_occupied = space_.state(cell) == CellState::occupied;
    if (search_.through_walls) return is_occupied ? kThroughWall : 1.0;
    return is_occupied || room_m(cell) < settings_.min_radius_m ? kInfinite : 1.0;
  }

  [[nodiscard]] CellBox search_box() const {
    constexpr double kRim_m = 1.5;
    return space_.box().grown(static_cast<int>(kRim_m / space_.cell_m()));
  }

  // About what it is to do without.
  void close() {
    closed_ = CellLayer<char>(search_box(), 0, 0);
    const int reach = static_cast<int>(settings_.same_m / space_.cell_m()) + 1;
    for (const Point& place : search_.without)
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
          const Cell c = space_.cell_at(place) + Cell{dx, dy};
          if (closed_.box().contains(c) && (space_.centre_of(c) - place).norm() < settings_.same_m) closed_[c] = 1;
        }
  }

  // Most of what is in reach has nothing else about it: nothing spreads from there.
  [[nodiscard]] bool leads_beyond(Cell cell) const {
    return std::ranges::any_of(kNeighbours, [&](Cell step) { return !reach_.at(cell + step); });
  }

  void spread() {
    close();
    const CellBox box = search_box();
    beyond_ = {CellLayer<float>(box, std::numeric_limits<float>::infinity(), 0.0F),
               CellLayer<std::int8_t>(box, -1, -1)};
    using Entry = std::pair<float, std::pair<int, int>>;  // cost, (y, x)
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x)
        if (reach_.at({x, y})) {
          beyond_.cost_m[{x, y}] = 0.0F;
          if (leads_beyond({x, y})) open.push({0.0F, {y, x}});
        }
    const double max_m = search_.through_walls ? kThroughWall * settings_.max_wall_m : kInfinite;
    while (!open.empty()) {
      const auto [cost, at] = open.top();
      open.pop();
      const Cell cell{at.second, at.first};
      if (cost > beyond_.cost_m.at(cell) || cost > max_m) continue;
      for (int k = 0; k < 8; ++k) {
        const Cell next = cell + kNeighbours[k];
        if (!box.contains(next) || reach_.at(next)) continue;
        const double step_m = space_.cell_m() * (k == 0 || k == 2 || k == 5 || k == 7 ? std::sqrt(2.0) : 1.0);
        const auto next_cost = static_cast<float>(cost + step_m * price(next));
        if (next_cost >= beyond_.cost_m.at(next)) continue;
        beyond_.cost_m[next] = next_cost;
        beyond_.came_from[next] = static_cast<std::int8_t>(k);
        open.push({next_cost, {next.y, next.x}});
      }
    }
  }

  // Room for the robot that it does not get to; of suspected ones, what echoes have come through.
  [[nodiscard]] std::vector<CellGroup> places_beyond() const {
    std::vector<Cell> cells;
    const CellBox box = search_box();
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x) {
        const Cell c{x, y};
        if (reach_.at(c) || space_.state(c) == CellState::occupied || !(beyond_.cost_m.at(c) < kInfinite)) continue;
        if (search_.through_walls ? is_seen_behind_wall(c) : room_m(c) >= space_.min_distance_m()) cells.push_back(c);
      }
    std::vector<CellGroup> groups = grouped(cells, 1);
    const double min_m2 = search_.through_walls ? settings_.seen_through_m2 : settings_.room_behind_m2;
    const double min_depth_m = search_.through_walls ? 0.0 : settings_.min_depth_m;
    const auto is_deep = [&](Cell c) { return beyond_.cost_m.at(c) >= min_depth_m; };
    std::erase_if(groups, [&](const CellGroup& g) { return area_m2(g) < min_m2 || std::ranges::none_of(g, is_deep); });
    return groups;
  }

  [[nodiscard]] bool is_seen_behind_wall(Cell cell) const {
    return grid_.log_odds(cell) <= kSeenThrough && beyond_.cost_m.at(cell) > kThroughWall * space_.cell_m();
  }

  // From what is in reach to the nearest cell of the place.
  [[nodiscard]] std::vector<Cell> path_to(const CellGroup& place) const {
    Cell at = *std::ranges::min_element(place, {}, [&](Cell c) { return beyond_.cost_m.at(c); });
    std::vector<Cell> path{at};
    while (beyond_.came_from.at(at) >= 0) {
      at = at + kNeighbours[7 - beyond_.came_from.at(at)];
      path.push_back(at);
    }
    std::ranges::reverse(path);
    return path;
  }

  // A roomy cell of the place, a little further in than where it begins.
  [[nodiscard]] Point inside(const CellGroup& place) const {
    float first_m = std::numeric_limits<float>::infinity();
    for (const Cell c : place) first_m = std::min(first_m, beyond_.cost_m.at(c));
    Cell best = place.front();
    double best_m = -kInfinite;
    for (const Cell c : place) {
      const double in_m = beyond_.cost_m.at(c) - first_m;
      if (in_m > settings_.beyond_m) continue;
      const double roomy_m = std::min(room_m(c), space_.min_distance_m() + 0.3) + 0.5 * in_m;
      if (roomy_m <= best_m) continue;
      best = c;
      best_m = roomy_m;
    }
    return space_.centre_of(best);
  }

  [[nodiscard]] std::optional<Passage> passage_to(const CellGroup& place) const {
    const std::vector<Cell> path = path_to(place);
    const auto narrowest = std::ranges::min_element(path, {}, [&](Cell c) { return room_m(c); });
    Passage passage;
    passage.at_m = space_.centre_of(*narrowest);
    passage.width_m = search_.through_walls ? 0.0 : 2.0 * room_m(*narrowest);
    passage.behind_m2 = search_.through_walls ? area_m2(place) : 0.0;
    passage.beyond_m = inside(place);
    const std::optional<Cell> lookout =
        lookout_before(passage.at_m, ahead_of(*narrowest, passage.beyond_m - space_.centre_of(path.front())));
    if (!lookout) return std::nullopt;
    passage.lookout = *lookout;
    return passage;
  }

  // Across the line to the nearest post, about as `towards`.
  [[nodiscard]] Point ahead_of(Cell narrowest, const Point& towards) const {
    const int reach = static_cast<int>(room_m(narrowest) / space_.cell_m()) + 1;
    std::optional<Cell> post;
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const Cell c = narrowest + Cell{dx, dy};
        if (space_.state(c) != CellState::occupied) continue;
        if (!post || squared(c - narrowest) < squared(*post - narrowest)) post = c;
      }
    if (!post || *post == narrowest) return towards.normalized();
    const Point along = space_.centre_of(*post) - space_.centre_of(narrowest);
    const Point across = Point(-along.y(), along.x()).normalized();
    return across.dot(towards) >= 0.0 ? across : Point(-across);
  }
  [[nodiscard]] static int squared(Cell c) { return c.x * c.x + c.y * c.y; }

  // In reach, in sight of the place, and straight before it.
  [[nodiscard]] std::optional<Cell> lookout_before(const Point& at_m, const Point& ahead) const {
    const Point ideal_m = at_m - settings_.look_from_m * ahead;
    const int reach = static_cast<int>(std::ceil(2.0 * settings_.look_from_m / space_.cell_m()));
    const Cell centre = space_.cell_at(at_m);
    std::optional<Cell> best;
    double best_m = kInfinite;
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const Cell c = centre + Cell{dx, dy};
        if (!reach_.at(c) || (space_.centre_of(c) - at_m).norm() < settings_.look_at_least_from_m) continue;
        const double off_m = (space_.centre_of(c) - ideal_m).norm();
        if (off_m >= best_m || !space_.sees(space_.centre_of(c), centre)) continue;
        best = c;
        best_m = off_m;
      }
    return best;
  }

  const FreeSpace& space_;
  const OccupancyGrid& grid_;
  const CellLayer<char>& reach_;
  Point robot_;
  const PassageSearch& search_;
  const PassageSettings& settings_;
  Beyond beyond_;
  CellLayer<char> closed_;
};

}  // namespace

void PassageSettings::describe(Fields<PassageSettings>& fields) {
  using C = PassageSettings;
  fields.number("min_radius_m", &C::min_radius_m, {0.01, 5.0}, "m",
                "a passage twice this wide on the map is looked at: sonars draw openings narrower than they are");
  fields.number("drive_radius_m", &C::drive_radius_m, {0.01, 5.0}, "m",
                "one that is twice this wide on the map leads to what is not known yet");
  fields.number("room_behind_m2", &C::room_behind_m2, {0.0, 1e4}, "m2",
                "when there may be so much room for the robot's centre behind it");
  fields.number("min_depth_m", &C::min_depth_m, {0.0, 50.0}, "m",
                "that reaches at least so far from what is in reach: a strip along a wall is no room");
  fields.number("seen_through_m2", &C::seen_through_m2, {0.0, 1e4}, "m2",
                "a wall is looked at again when echoes have come through it from so much behind it");
  fields.number("missed_m2", &C::missed_m2, {0.0, 1e4}, "m2",
                "a wall that was not looked at makes the step fail when echoes have shown so much behind it");
  fields.number("max_wall_m", &C::max_wall_m, {0.0, 5.0}, "m", "within this of what is in reach");
  fields.number("look_from_m", &C::look_from_m, {0.1, 5.0}, "m",
                "a passage is looked at from here, straight before it");
  fields.number("look_again_from_m", &C::look_again_from_m, {0.1, 5.0}, "m", "the same when it is looked at once more");
  fields.number("look_at_least_from_m", &C::look_at_least_from_m, {0.0, 5.0}, "m",
                "and never from nearer than this: it is no passage then");
  fields.number("beyond_m", &C::beyond_m, {0.0, 5.0}, "m", "so far into the room behind it the robot drives at first");
  fields.number("same_m", &C::same_m, {0.0, 50.0}, "m", "passages this near to each other are the same");
  fields.number(
      "narrow_cost", &C::narrow_cost, {0.0, 1000.0}, "",
      "metres of path that a passage comes later for each metre that the robot's width and clearance lack in it");
  fields.number(
      "seen_bonus_m_per_m2", &C::seen_bonus_m_per_m2, {0.0, 1000.0}, "m/m2",
      "metres of path that a wall is looked at earlier for each square metre that echoes have shown behind it");
  fields.number("max_seen_m2", &C::max_seen_m2, {0.0, 1000.0}, "m2", "and for so much at most");
  fields.number("look_beside_m", &C::look_beside_m, {0.0, 1000.0}, "m",
                "metres of path that a wall is looked at later for each look at the wall beside it");
  fields.number("beside_m", &C::beside_m, {0.0, 100.0}, "m", "within this");
  fields.integer("max_suspects", &C::max_suspects, {0.0, 1e4}, "at most so many walls are looked at again");
  fields.number(
      "dared_ratio", &C::dared_ratio, {0.0, 10.0}, "",
      "when nothing else is left, one that was heard to be at least this share of the robot's width is driven "
      "into once, slowly, though it is too narrow: echoes tell the least that is open");
  fields.integer("max_tries", &C::max_tries, {0.0, 100.0}, "how often a passage is tried before it is given up");
  fields.integer("max_passes", &C::max_passes, {1.0, 1000.0},
                 "how often one is driven through again on the way to something behind it");
  fields.group("echoes", &C::echoes, "how wide a passage is by the echoes of a look");
  fields.group("passed", &C::passed,
               "what counts as passed by echoes while the robot drives: walls that echoes have passed are looked at");
}

CellLayer<char> reach_of(const FreeSpace& space, const std::vector<Pose2>& trace) {
  CellLayer<char> reach(space.box(), 0, 0);
  CellGroup queue;
  const auto add = [&](Cell c) {
    if (!reach.box().contains(c) || reach.at(c) || space.state(c) != CellState::free) return;
    reach[c] = 1;
    queue.push_back(c);
  };
  for (const Pose2& pose : trace) add(space.cell_at(pose.position()));
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const Cell step : kNeighbours)
      if (const Cell next = queue[i] + step; space.distance_m(next) >= space.min_distance_m()) add(next);
  return reach;
}

std::optional<Passage> nearest_passage(const FreeSpace& space, const OccupancyGrid& grid, const CellLayer<char>& reach,
                                       const Point& robot, const PassageSearch& search,
                                       const PassageSettings& settings) {
  return PassageFinder(space, grid, reach, robot, search, settings).nearest();
}

double seen_behind_walls_m2(const FreeSpace& space, const OccupancyGrid& grid, const CellLayer<char>& reach,
                            const std::vector<Point>& without, const PassageSettings& settings) {
  const PassageSearch search{true, without};
  return PassageFinder(space, grid, reach, {0.0, 0.0}, search, settings).seen_behind_walls_m2();
}

}  // namespace cairn::behaviours
