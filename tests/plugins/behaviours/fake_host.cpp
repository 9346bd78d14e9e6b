#include "tests/plugins/behaviours/fake_host.hpp"

#include <algorithm>
#include <numbers>
#include <sstream>

#include "maps/grid/travel_field.hpp"

namespace cairn::behaviours {
namespace {
constexpr double kTick_s = 0.04;
constexpr int kRevealEvery = 5;
constexpr int kRays = 240;
}  // namespace

FakeHost::FakeHost(const std::string& drawing, const FakeHostSettings& settings)
    : grid(settings.cell_m), settings_(settings) {
  std::istringstream lines(drawing);
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(' ') != std::string::npos) rows_.push_back(line.substr(line.find_first_not_of(' ')));
  const auto side = settings.character_m;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const std::size_t c = rows_[r].find('R');
    if (c == std::string::npos) continue;
    T_map_robot = {(static_cast<double>(c) + 0.5) * side, (static_cast<double>(rows_.size() - r) - 0.5) * side, 0.0};
  }
  if (settings.all_known) {
    const int per_side = static_cast<int>(std::lround(side / settings.cell_m));
    for (int y = 0; y < static_cast<int>(rows_.size()) * per_side; ++y)
      for (int x = 0; x < static_cast<int>(rows_[0].size()) * per_side; ++x) mark({x, y});
  }
  T_map_start = T_map_robot;
  reveal();
}

void FakeHost::move_map(const Point& by_m) {
  OccupancyGrid moved(settings_.cell_m);
  const CellBox box = grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (grid.state({x, y}) != CellState::unknown)
        moved.set_log_odds(moved.cell_at(grid.centre_of({x, y}) + by_m), grid.log_odds({x, y}));
  grid = std::move(moved);
  drawn_from_m_ += by_m;
  const Pose2 T{by_m.x(), by_m.y(), 0.0};
  last_map_move.emplace(std::vector<Pose2>{T_map_robot}, std::vector<Pose2>{T * T_map_robot});
  ++map_moves;
  T_map_robot = T * T_map_robot;
  T_map_start = T * T_map_start;
  for (const auto& [id, known] : graph.landmarks()) {
    Landmark& landmark = *graph.find(id);
    landmark.T_map_landmark = T * landmark.T_map_landmark;
    if (landmark.access) landmark.access = T * *landmark.access;
  }
}

bool FakeHost::is_solid(const Point& p_map) const {
  const Point p = p_map - drawn_from_m_;
  const int c = static_cast<int>(std::floor(p.x() / settings_.character_m));
  const int up = static_cast<int>(std::floor(p.y() / settings_.character_m));
  const int r = static_cast<int>(rows_.size()) - 1 - up;
  if (r < 0 || r >= static_cast<int>(rows_.size())) return false;
  const std::string& row = rows_[static_cast<std::size_t>(r)];
  return c >= 0 && c < static_cast<int>(row.size()) && row[static_cast<std::size_t>(c)] == '#';
}

void FakeHost::solidify(const Point& p, bool solid) {
  const int c = static_cast<int>(std::floor(p.x() / settings_.character_m));
  const int r = static_cast<int>(rows_.size()) - 1 - static_cast<int>(std::floor(p.y() / settings_.character_m));
  rows_.at(static_cast<std::size_t>(r)).at(static_cast<std::size_t>(c)) = solid ? '#' : '.';
}

void FakeHost::mark(Cell cell) {
  grid.set_log_odds(cell, is_solid(grid.centre_of(cell)) ? 600 : -600);
}

void FakeHost::reveal() {
  if (settings_.sight_m <= 0.0) return;
  const double step_m = 0.5 * settings_.cell_m;
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRays;
    const Point direction{std::cos(angle), std::sin(angle)};
    for (double r_m = 0.0; r_m <= settings_.sight_m; r_m += step_m) {
      const Cell cell = grid.cell_at(T_map_robot.position() + direction * r_m);
      mark(cell);
      if (is_solid(grid.centre_of(cell))) break;
    }
  }
}

double FakeHost::distance_to_solid_m() const {
  const double side = settings_.character_m;
  double nearest = 1e9;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < rows_[r].size(); ++c) {
      if (rows_[r][c] != '#') continue;
      const Point low{static_cast<double>(c) * side, static_cast<double>(rows_.size() - 1 - r) * side};
      const Point p = T_map_robot.position() - drawn_from_m_;
      const double dx = std::max({low.x() - p.x(), 0.0, p.x() - low.x() - side});
      const double dy = std::max({low.y() - p.y(), 0.0, p.y() - low.y() - side});
      nearest = std::min(nearest, std::hypot(dx, dy));
    }
  }
  return nearest;
}

void FakeHost::move(const Twist& twist) {
  const Pose2 before = T_map_robot;
  T_map_robot = T_map_robot * Pose2{twist.v_mps * kTick_s, 0.0, twist.w_radps * kTick_s};
  const double nearest = distance_to_solid_m();
  if (nearest < robot.radius_m && twist.v_mps != 0.0) T_map_robot = {before.x_m, before.y_m, T_map_robot.theta_rad};
  nearest_solid_m = std::min(nearest_solid_m, nearest);
  driven_m += (T_map_robot.position() - before.position()).norm();
}

PlanResult FakeHost::plan(const PlanRequest& request) {
  planned.push_back(request);
  if (planner) return planner(request);
  PlanResult result;
  const DistanceField space(grid, UnknownPolicy::avoid);
  Place to = request.to;
  if (!to.landmarks.empty()) {
    const Landmark& landmark = graph.landmarks().at(to.landmarks.front());
    to.pose = landmark.access.value_or(landmark.T_map_landmark);
    result.landmarks = {landmark.id};
  }
  Point from{0.0, 0.0};
  if (request.from.pose) {
    from = request.from.pose->position();
  } else {
    const Landmark& landmark = graph.landmarks().at(request.from.landmarks.front());
    from = landmark.access.value_or(landmark.T_map_landmark).position();
  }
  const TravelField travel(space, from, request.radius_m + settings_.cell_m);
  const std::vector<Cell> cells = travel.path_to(space.cell_at(to.pose->position()));
  if (cells.empty()) {
    result.reason = "no way leads there";
    return result;
  }
  result.outcome = PlanOutcome::solved;
  result.cost_m = travel.cost_m(space.cell_at(to.pose->position()));
  for (const Cell c : cells) result.path.push_back({space.centre_of(c).x(), space.centre_of(c).y(), 0.0});
  return result;
}

WorldView FakeHost::view(const Observation* seen) const {
  WorldView world{grid, graph, robot, {T_map_robot, Eigen::Matrix3d::Zero()}, time_s, seen, speed_reduction_ratio};
  world.T_map_start = T_map_start;
  world.pose.trust = trust;
  world.hierarchies = hierarchies;
  world.map_moves = map_moves;
  world.last_map_move = last_map_move ? &*last_map_move : nullptr;
  return world;
}

ControlResult FakeHost::control(const ControlRequest& request) {
  return controller->control(request, view(nullptr));
}

Status FakeHost::tick(Behaviour& behaviour) {
  wanted_ = {};
  Observation seen;
  if (observe) seen = observe(*this);
  Status status = behaviour.tick(view(observe ? &seen : nullptr), *this);
  const Twist allowed = collision_monitor ? collision_monitor(T_map_robot, wanted_) : wanted_;
  speed_reduction_ratio = 0.0;
  if (wanted_.v_mps != 0.0)
    speed_reduction_ratio = 1.0 - allowed.v_mps / wanted_.v_mps;
  else if (wanted_.w_radps != 0.0)
    speed_reduction_ratio = 1.0 - allowed.w_radps / wanted_.w_radps;
  move(allowed);
  driven.push_back(T_map_robot);
  time_s += kTick_s;
  if (++ticks_ % kRevealEvery == 0) reveal();
  return status;
}

std::optional<double> FakeHost::first_left_s(Behaviour& behaviour, double at_most_s) {
  const double end_s = time_s + at_most_s;
  Status status;
  while (status.state == StepState::running && !status.left_s && time_s < end_s) status = tick(behaviour);
  return status.left_s;
}

Status FakeHost::run(Behaviour& behaviour, double at_most_s) {
  const double end_s = time_s + at_most_s;
  Status status;
  while (status.state == StepState::running && time_s < end_s) status = tick(behaviour);
  return status;
}

std::string FakeHost::picture() const {
  const CellBox box = grid.bounds();
  std::vector<std::string> rows(static_cast<std::size_t>(box.height()),
                                std::string(static_cast<std::size_t>(box.width()), ' '));
  const auto at = [&](Cell c) -> char& {
    return rows[static_cast<std::size_t>(box.max.y - 1 - c.y)][static_cast<std::size_t>(c.x - box.min.x)];
  };
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      at({x, y}) = grid.state({x, y}) == CellState::occupied ? '#' : grid.state({x, y}) == CellState::free ? '.' : ' ';
  for (const Pose2& pose : driven)
    if (box.contains(grid.cell_at(pose.position()))) at(grid.cell_at(pose.position())) = 'o';
  if (box.contains(grid.cell_at(T_map_robot.position()))) at(grid.cell_at(T_map_robot.position())) = 'R';
  std::string text = "\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

}  // namespace cairn::behaviours
