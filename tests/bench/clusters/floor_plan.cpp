#include "tests/bench/clusters/floor_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "maps/base/portable_random.hpp"
#include "maps/exchange/grids/map_server.hpp"
#include "tests/bench/graph/unpacked.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr double kCell_m = 0.05;
constexpr double kWall_m = 0.15;
constexpr int kDoorway_cells = 8;  // rooms that meet over so few cells of no room are joined by a doorway
constexpr double kSmallestRoom_m2 = 1.5;
constexpr std::array<Cell, 4> kBeside{Cell{1, 0}, Cell{-1, 0}, Cell{0, 1}, Cell{0, -1}};

std::size_t index_in(const CellBox& box, Cell cell) {
  return static_cast<std::size_t>(cell.y - box.min.y) * static_cast<std::size_t>(box.width()) +
         static_cast<std::size_t>(cell.x - box.min.x);
}

// Rooms grow over the free cells of no room until they meet.
void grow_rooms(FloorPlan& plan) {
  std::deque<std::pair<Cell, int>> queue;
  for (int y = plan.box.min.y; y < plan.box.max.y; ++y)
    for (int x = plan.box.min.x; x < plan.box.max.x; ++x)
      if (plan.room[index_in(plan.box, {x, y})] >= 0) queue.emplace_back(Cell{x, y}, 0);
  std::vector<int> distance(plan.room.size(), 0);
  while (!queue.empty()) {
    const auto [cell, steps] = queue.front();
    queue.pop_front();
    const int own = plan.room[index_in(plan.box, cell)];
    for (const Cell step : kBeside) {
      const Cell next = cell + step;
      if (!plan.box.contains(next) || plan.grid.state(next) != CellState::free) continue;
      int& other = plan.room[index_in(plan.box, next)];
      if (other < 0) {
        other = own;
        distance[index_in(plan.box, next)] = steps + 1;
        queue.emplace_back(next, steps + 1);
      } else if (other != own && steps + distance[index_in(plan.box, next)] <= kDoorway_cells) {
        plan.doors.insert(std::minmax(own, other));
      }
    }
  }
}

class Building {
 public:
  explicit Building(std::uint64_t seed) : random_(seed, 7) {
    plan_.name = "building " + std::to_string(seed);
    const int corridors = random_.whole(1, 2);
    length_m_ = random_.between(16.0, 32.0);
    double y_m = 0.0;
    const double across_m = random_.between(1.5, 2.4);  // the corridor that joins the others
    for (int i = 0; i < corridors; ++i) {
      y_m = row(y_m, true);
      const double wide_m = random_.between(1.5, 2.4);
      carve(0.0, y_m, length_m_, y_m + wide_m, kCorridor);
      corridors_m_.push_back(y_m);
      y_m = row(y_m + wide_m + kWall_m, false);
    }
    if (corridors > 1) carve(-across_m, corridors_m_.front(), 0.0, corridors_m_.back() + 1.5, kCorridor);
  }

  FloorPlan finished() {
    for (const auto& [a, b] : doors_) carve(a.x(), a.y(), b.x(), b.y(), -1);
    const CellBox inner = plan_.grid.bounds();
    plan_.box = inner.grown(4);
    plan_.room.assign(static_cast<std::size_t>(plan_.box.width()) * static_cast<std::size_t>(plan_.box.height()), -1);
    for (const auto& [cell, room] : rooms_of_cells_)
      if (plan_.grid.state(cell) == CellState::free) plan_.room[index_in(plan_.box, cell)] = room;
    for (int y = plan_.box.min.y; y < plan_.box.max.y; ++y)
      for (int x = plan_.box.min.x; x < plan_.box.max.x; ++x)
        if (plan_.grid.state({x, y}) != CellState::free) plan_.grid.set_log_odds({x, y}, log_odds_of(0.95));
    grow_rooms(plan_);
    return std::move(plan_);
  }

 private:
  static constexpr int kCorridor = 0;

  // A row of rooms whose doors lead up or down; where it ends.
  double row(double y_m, bool doors_lead_up) {
    const double depth_m = random_.between(3.0, 6.0);
    double x_m = 0.0;
    while (x_m < length_m_ - 2.5) {
      double wide_m = random_.between(2.5, 7.0);
      if (x_m + wide_m > length_m_ - 2.5) wide_m = length_m_ - x_m;
      room(x_m, y_m, x_m + wide_m - kWall_m, y_m + depth_m, doors_lead_up);
      x_m += wide_m;
    }
    return y_m + depth_m + kWall_m;
  }

  void room(double x0, double y0, double x1, double y1, bool door_leads_up) {
    carve(x0, y0, x1, y1, ++rooms_);
    const double door_m = random_.between(0.8, 1.2);
    const double at = random_.between(x0 + 0.2, x1 - 0.2 - door_m);
    const double edge = door_leads_up ? y1 : y0 - kWall_m;
    doors_.emplace_back(Point(at, edge - 0.01), Point(at + door_m, edge + kWall_m + 0.01));
    if (x0 > 0.0 && random_.share() < 0.25) {
      const double beside = random_.between(y0 + 0.2, y1 - 1.4);
      doors_.emplace_back(Point(x0 - kWall_m - 0.01, beside), Point(x0 + 0.01, beside + random_.between(0.8, 1.2)));
    }
    furnish(x0, y0, x1, y1);
  }

  // Along the walls and in the middle, never near a door's wall.
  void furnish(double x0, double y0, double x1, double y1) {
    const int pieces = random_.whole(0, 3);
    for (int i = 0; i < pieces; ++i) {
      const double wide_m = random_.between(0.4, 1.4);
      const double deep_m = random_.between(0.4, 0.9);
      const double x = random_.between(x0 + 0.9, std::max(x0 + 0.9, x1 - 0.9 - wide_m));
      const double y = random_.between(y0 + 0.9, std::max(y0 + 0.9, y1 - 0.9 - deep_m));
      for_each_cell(x, y, std::min(x + wide_m, x1 - 0.9), std::min(y + deep_m, y1 - 0.9),
                    [&](Cell cell) { plan_.grid.set_log_odds(cell, log_odds_of(0.95)); });
    }
  }

  template <class Do>
  void for_each_cell(double x0, double y0, double x1, double y1, Do act) {
    const Cell low = plan_.grid.cell_at({x0, y0});
    const Cell high = plan_.grid.cell_at({x1, y1});
    for (int y = low.y; y < high.y; ++y)
      for (int x = low.x; x < high.x; ++x) act(Cell{x, y});
  }

  void carve(double x0, double y0, double x1, double y1, int room) {
    for_each_cell(x0, y0, x1, y1, [&](Cell cell) {
      if (room < 0 && plan_.grid.state(cell) == CellState::free) return;
      plan_.grid.set_log_odds(cell, log_odds_of(0.05));
      if (room >= 0) rooms_of_cells_.emplace_back(cell, room);
    });
  }

  FloorPlan plan_{{}, OccupancyGrid(kCell_m), {}, {}, {}};
  PortableRandom random_;
  double length_m_ = 0.0;
  int rooms_ = kCorridor;
  std::vector<double> corridors_m_;
  std::vector<std::pair<Point, Point>> doors_;
  std::vector<std::pair<Cell, int>> rooms_of_cells_;
};

// The white pieces of the picture of the rooms.
void label_rooms(FloorPlan& plan, const OccupancyGrid& truth) {
  int rooms = 0;
  const auto is_open = [&](Cell cell) {
    return plan.box.contains(cell) && truth.state(cell) == CellState::free && plan.room[index_in(plan.box, cell)] < 0;
  };
  for (int y = plan.box.min.y; y < plan.box.max.y; ++y)
    for (int x = plan.box.min.x; x < plan.box.max.x; ++x) {
      if (!is_open({x, y})) continue;
      std::vector<Cell> piece{{x, y}};
      plan.room[index_in(plan.box, {x, y})] = rooms;
      for (std::size_t at = 0; at < piece.size(); ++at)
        for (const Cell step : kBeside)
          if (const Cell next = piece[at] + step; is_open(next)) {
            plan.room[index_in(plan.box, next)] = rooms;
            piece.push_back(next);
          }
      if (static_cast<double>(piece.size()) * kCell_m * kCell_m < kSmallestRoom_m2)
        for (const Cell cell : piece) plan.room[index_in(plan.box, cell)] = -2;
      else
        ++rooms;
    }
}

OccupancyGrid picture_grid(const fs::path& file) {
  return grid_of(parse_grey_picture(unpacked(file), file.string()), {}, file.string()).grid;
}

}  // namespace

int FloorPlan::room_at(Cell cell) const {
  return box.contains(cell) ? room[index_in(box, cell)] : -1;
}

FloorPlan generated_building(std::uint64_t seed) {
  return Building(seed).finished();
}

std::vector<FloorPlan> ipa_rooms(bool with_furniture) {
  const fs::path folder = data_folder() / "occ_maps" / "ipa_rooms";
  std::vector<FloorPlan> plans;
  for (const std::string name : {"Freiburg52_scan", "Freiburg79_scan", "lab_a_scan", "lab_c_scan", "lab_intel",
                                 "lab_ipa", "office_a", "office_b", "office_d", "office_h"}) {
    const fs::path truth = folder / (name + "_gt_segmentation.png");
    if (!fs::exists(truth)) continue;
    FloorPlan plan{name, picture_grid(folder / (name + (with_furniture ? "_furnitures.png" : ".png"))), {}, {}, {}};
    plan.box = plan.grid.bounds();
    plan.room.assign(static_cast<std::size_t>(plan.box.width()) * static_cast<std::size_t>(plan.box.height()), -1);
    label_rooms(plan, picture_grid(truth));
    for (int& room : plan.room) room = std::max(room, -1);
    grow_rooms(plan);
    plans.push_back(std::move(plan));
  }
  return plans;
}

}  // namespace cairn
