// A building of square rooms with a door to each neighbour and a landmark in each, whose grid may be read as it is
// asked for.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include "framework/contracts/view/cell_source.hpp"
#include "planners/common/disc_space/routes.hpp"
#include "planners/hybrid/windows/local_query.hpp"
#include "planners/landmark_search/landmark_search.hpp"
#include "planners/ompl/ompl_planner.hpp"

namespace cairn::test {

// Copies tiles of a whole grid, and counts them.
class CountedCells : public CellSource {
 public:
  CountedCells(const OccupancyGrid& whole, OccupancyGrid& read) : whole_(whole), read_(read) {}
  void require(const CellBox& cells) const override {
    const CellBox box = intersected(cells, whole_.bounds());
    for (int ty = box.min.y >> 6; ty <= (box.max.y - 1) >> 6; ++ty)
      for (int tx = box.min.x >> 6; tx <= (box.max.x - 1) >> 6; ++tx)
        if (const LogOdds* const values = whole_.cells_of_tile({tx, ty}); values != nullptr)
          if (tiles_.insert({tx, ty}).second) std::copy_n(values, 64 * 64, read_.cells_of_tile_for_writing({tx, ty}));
  }
  [[nodiscard]] std::size_t tiles() const { return tiles_.size(); }

 private:
  const OccupancyGrid& whole_;
  OccupancyGrid& read_;
  mutable std::set<Cell> tiles_;
};

struct RoomsWorld {
  static constexpr int kRoom_cells = 40;  // with one of its walls
  static constexpr int kDoor_cells = 8;

  int rooms;
  OccupancyGrid grid{0.1};
  LandmarkGraph graph;
  RobotModel robot;
  std::map<Cell, LandmarkId> landmark_in;
  std::map<std::pair<LandmarkId, LandmarkId>, RouteId> route_between;

  explicit RoomsWorld(int rooms_a_side) : rooms(rooms_a_side) {
    const int side = rooms * kRoom_cells + 1;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) grid.set_log_odds({x, y}, static_cast<LogOdds>(is_wall(x, y) ? 900 : -900));
    for (int y = 0; y < rooms; ++y)
      for (int x = 0; x < rooms; ++x) add_landmark({x, y});
    for (const auto& [room, id] : landmark_in)
      for (const Cell step : {Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}})
        if (landmark_in.contains(room + step)) add_route(room, room + step);
  }
  [[nodiscard]] Point middle_of(Cell room) const {
    return grid.centre_of({room.x * kRoom_cells + kRoom_cells / 2, room.y * kRoom_cells + kRoom_cells / 2});
  }
  // Doors are not all in one line, so that paths turn.
  [[nodiscard]] static int door_of(int room) { return 6 + (room * 7) % (kRoom_cells - 6 - kDoor_cells); }
  [[nodiscard]] WorldView view() const { return {grid, graph, robot, {}, 0.0}; }
  void fill(Cell low, Cell high, LogOdds value) {
    for (int y = low.y; y < high.y; ++y)
      for (int x = low.x; x < high.x; ++x) grid.set_log_odds({x, y}, value);
  }
  // The doors of a room, as wide as they are.
  void close_doors_of(Cell room) {
    const Cell low{room.x * kRoom_cells, room.y * kRoom_cells};
    const Cell high = low + Cell{kRoom_cells, kRoom_cells};
    fill(low, {high.x + 1, low.y + 1}, 900);
    fill({low.x, high.y}, {high.x + 1, high.y + 1}, 900);
    fill(low, {low.x + 1, high.y + 1}, 900);
    fill({high.x, low.y}, {high.x + 1, high.y + 1}, 900);
  }
  [[nodiscard]] Point any_place(std::mt19937_64& random, double radius_m) const {
    std::uniform_real_distribution<double> any(0.0, rooms * kRoom_cells * grid.cell_m());
    for (;;) {
      const double x = any(random);
      const Point at(x, any(random));
      if (sweep_is_free(grid, {}, at, at, radius_m + 0.01)) return at;
    }
  }

 private:
  [[nodiscard]] bool is_wall(int x, int y) const {
    const bool upright = x % kRoom_cells == 0;
    const bool level = y % kRoom_cells == 0;
    if (!upright && !level) return false;
    const int side = rooms * kRoom_cells;
    if (x == 0 || y == 0 || x == side || y == side || (upright && level)) return true;
    const int along = upright ? y : x;
    const int from = door_of(upright ? y / kRoom_cells + x / kRoom_cells : x / kRoom_cells + 2 * (y / kRoom_cells));
    return along % kRoom_cells < from || along % kRoom_cells >= from + kDoor_cells;
  }
  void add_landmark(Cell room) {
    Landmark landmark;
    landmark.category = "square";
    const Point at = middle_of(room);
    landmark.T_map_landmark = {at.x(), at.y(), 0.0};
    landmark.access = landmark.T_map_landmark;
    landmark_in[room] = graph.add(landmark);
  }
  // Straight to the door, and straight on.
  void add_route(Cell from, Cell to) {
    const bool sideways = from.y == to.y;
    const Cell high{std::max(from.x, to.x), std::max(from.y, to.y)};
    const int door = sideways ? door_of(high.y + high.x) : door_of(high.x + 2 * high.y);
    const int middle = door + kDoor_cells / 2;
    const Point at = sideways ? grid.centre_of({high.x * kRoom_cells, high.y * kRoom_cells + middle})
                              : grid.centre_of({high.x * kRoom_cells + middle, high.y * kRoom_cells});
    Route route;
    route.from = landmark_in[from];
    route.to = landmark_in[to];
    const Point off = sideways ? Point(to.x > from.x ? 0.6 : -0.6, 0.0) : Point(0.0, to.y > from.y ? 0.6 : -0.6);
    for (const Point& p : {middle_of(from), Point(at - off), Point(at + off), middle_of(to)})
      route.trajectory.push_back({p.x(), p.y(), 0.0});
    route.cost_m = length_of(route.trajectory);
    const auto key = std::pair{route.from, route.to};
    route_between[key] = graph.add_route(route);
  }
};

// Asks in windows, with the shipped planners.
class LocalAsker {
 public:
  HybridConfig config;
  WindowRules windows{3.0, 1, 4, 6.0};
  static constexpr double kRadius_m = 0.2;

  [[nodiscard]] LocalAnswer answer(const PlanRequest& request, const WorldView& world) const {
    const PlannerTraits traits = path_planner_->traits();
    const HybridTools tools{config, traits, usual_, avoiding_, kept_, *path_planner_, route_planner_};
    EndRules ends;
    ends.radius_m = request.radius_m;
    const LegRules legs{request.radius_m, request.radius_m + kMinRadius_m, config.detour_ratio, request.seed};
    const AnswerRules answers{{}, request.radius_m, request.radius_m, config.shortcut};
    return answer_locally(tools, ends, legs, answers, windows, request, world, {});
  }
  // By the whole grid, as for small maps.
  [[nodiscard]] PlanResult whole(const PlanRequest& request, const WorldView& world) const {
    return HybridPlanner(config, path_planner_, route_planner_).plan(request, world, {});
  }
  [[nodiscard]] static PlanRequest between(const Point& from, const Point& to) {
    PlanRequest request;
    request.from.pose = Pose2{from.x(), from.y(), 0.0};
    request.to.pose = Pose2{to.x(), to.y(), 0.0};
    request.radius_m = kRadius_m;
    return request;
  }

 private:
  std::shared_ptr<const PathPlanner> path_planner_ = std::make_shared<OmplPlanner>(OmplConfig{});
  std::shared_ptr<const RoutePlanner> route_planner_ = std::make_shared<LandmarkSearch>();
  HybridGround usual_;
  HybridGround avoiding_;
  WindowCache kept_;
};

}  // namespace cairn::test
