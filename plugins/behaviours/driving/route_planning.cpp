// How the route driver finds a way: by the planner, by its own eyes, by looking again.

#include <algorithm>

#include "plugins/behaviours/driving/lookout_route.hpp"
#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/driving/speckles.hpp"
#include "plugins/behaviours/errands/place_name.hpp"

namespace cairn::behaviours {
namespace {

// Room asked of the planner beside the robot, the most first: more than the local planner keeps, then what a narrow
// door leaves, then nothing.
constexpr double kRooms_m[] = {0.12, 0.06, 0.0};
constexpr int kMaxPlans = 200;
constexpr int kMaxEscapes = 4;
constexpr double kEscapeClearance_m = 0.1;
constexpr double kSpaceAround_m = 12.0;
constexpr double kSpaceClearance_m = 0.08;
constexpr double kTightClearance_m = 0.03;
constexpr double kAroundGoal_m = 1.0;
constexpr int kMaxAcross_cells = 1000;
constexpr double kShutAround_m = 0.3;
constexpr double kFree = 0.1;  // probability of what is taken to be free
constexpr int kMaxLooks = 12;
constexpr int kLooksBeforeAgain = 6;  // then at the same places once more
constexpr double kAroundLook_m = 0.7;
constexpr int kMaxUnknownWays = 20;
// An opening of twice this is tried, slowly: sonars draw openings narrower than they are.
constexpr double kSqueezedRadius_m = 0.16;
constexpr int kLooksBeforeSqueezing = 2;
constexpr int kMaxNarrowGapTries = 3;
constexpr double kStandOff_m = 0.8;  // from what is looked at
constexpr double kStandOffNearer_m = 0.5;
constexpr double kBesideApart_m = 0.3;
constexpr double kBeforeGoal_m = 0.1;
constexpr double kBesideGoalFor_s = 6.0;

std::vector<Point> points_of(const std::vector<Pose2>& path) {
  std::vector<Point> points;
  points.reserve(path.size());
  for (const Pose2& pose : path) points.push_back(pose.position());
  return points;
}

// At least at what is before it: the place itself may be drawn inside a wall.
bool can_look_at(const Point& place, Cell from, const FreeSpace& space) {
  const Point stand = space.centre_of(from);
  const Point towards = stand - place;
  const double before_m = std::min(towards.norm(), kBeforeGoal_m);
  return towards.norm() < 1e-9 || space.sees(stand, space.cell_at(place + towards.normalized() * before_m));
}

// The nearest to a goal that is in reach, in sight of it and not where the robot has stood before.
std::optional<Cell> cell_beside(const Point& goal, double within_m, const FreeSpace& space,
                                const std::vector<Point>& stood) {
  const Cell at = space.cell_at(goal);
  std::optional<Cell> nearest;
  double nearest_m = within_m;
  const int reach = static_cast<int>(nearest_m / space.cell_m());
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = at + Cell{dx, dy};
      const Point place = space.centre_of(c);
      const double distance_m = (place - goal).norm();
      if (distance_m >= nearest_m || !space.reaches(c) || !can_look_at(goal, c, space)) continue;
      if (std::ranges::any_of(stood, [&](const Point& p) { return (p - place).norm() < kBesideApart_m; })) continue;
      nearest_m = distance_m;
      nearest = c;
    }
  }
  return nearest;
}

// Within what is known and about the goal.
void take_unknown_for_free(OccupancyGrid& map, const Point& goal) {
  const Cell to = map.cell_at(goal);
  const int around = static_cast<int>(kAroundGoal_m / map.cell_m());
  const CellBox known = map.bounds();
  CellBox box = CellBox{to, to + Cell{1, 1}}.grown(around);
  box = known.empty() ? box : united(known, box);
  if (box.width() > kMaxAcross_cells || box.height() > kMaxAcross_cells) return;
  const LogOdds free = log_odds_of(kFree);
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (map.state({x, y}) == CellState::unknown) map.set_log_odds({x, y}, free);
}

void occupy_around(const Point& p, OccupancyGrid& map) {
  const Cell at = map.cell_at(p);
  const int reach = static_cast<int>(kShutAround_m / map.cell_m());
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (dx * dx + dy * dy <= reach * reach) map.set_log_odds(at + Cell{dx, dy}, log_odds_of(1.0 - kFree));
}

}  // namespace

// What it has looked through; specks; and whatever stands alone where the robot has looked again: it is there if it
// echoes.
std::vector<Cell> RouteDriver::doubtful_cells(const OccupancyGrid& map) const {
  std::vector<Cell> cells = seen_through();
  const std::vector<Cell> speckles = speckles_of(map, map.bounds());
  cells.insert(cells.end(), speckles.begin(), speckles.end());
  const int around = static_cast<int>(kAroundLook_m / map.cell_m());
  for (const Point& seen : looked_at_) {
    const Cell at = map.cell_at(seen);
    const CellBox box = CellBox{at, at + Cell{1, 1}}.grown(around);
    const std::vector<Cell> islands = speckles_of(map, box, box.width() * box.height(), box.width() * box.height());
    cells.insert(cells.end(), islands.begin(), islands.end());
  }
  return cells;
}

void RouteDriver::doubt(const std::vector<Cell>& cells, const WorldView& world) {
  for (const Cell c : cells) {
    doubted_.insert(c);
    const auto looked = look_.through.find(c);
    const bool was_there = looked == look_.through.end() || looked->second < 0;
    if (was_there && echoes_.now().is_occupied(world.grid, c)) doubted_places_.push_back(world.grid.centre_of(c));
  }
}

// What a plan of this trust has left out of account.
void RouteDriver::doubt_as(Trust trust, const WorldView& world) {
  if (trust != Trust::all) doubt(doubtful_cells(echoes_.now().applied_to(world.grid, world.grid.bounds())), world);
}

void RouteDriver::doubt_along_path(const WorldView& world) {
  const int reach = static_cast<int>((world.robot.radius_m + kTightClearance_m) / world.grid.cell_m()) + 1;
  std::vector<Cell> cells;
  for (double along_m = 0.0; along_m < length_of(path_); along_m += world.grid.cell_m()) {
    const Cell centre = world.grid.cell_at(point_along(path_, along_m));
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx)
        if (dx * dx + dy * dy <= reach * reach) cells.push_back(centre + Cell{dx, dy});
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  doubt(cells, world);
}

FreeSpace RouteDriver::space_now(const WorldView& world, double clearance_m, Trust trust) const {
  const Point position = world.pose.T_map_robot.position();
  const Cell here = world.grid.cell_at(position);
  const int reach = static_cast<int>(kSpaceAround_m / world.grid.cell_m());
  const CellBox part = CellBox{here, here + Cell{1, 1}}.grown(reach);
  OccupancyGrid map = echoes_.now().applied_to(world.grid, part);
  if (trust != Trust::all)
    for (const Cell c : doubtful_cells(map)) map.set_log_odds(c, log_odds_of(kFree));
  if (trust >= Trust::only_solid) {
    take_unknown_for_free(map, goal_point(world).value_or(position));
    for (const TroubleSpot& spot : shut_) occupy_around(spot.at_m, map);
  }
  return FreeSpace(map, {position, world.robot.radius_m, clearance_m}, trace_, troubles_);
}

void RouteDriver::stop_doubting() {
  doubted_ = {};
  doubted_places_.clear();
}

bool RouteDriver::is_blocked(const WorldView& world, const std::vector<Point>& path, double along_m, double ahead_m,
                             double radius_m) const {
  const auto is_occupied = [&](Cell c) { return echoes_.now().is_occupied(world.grid, c) && !doubted_.contains(c); };
  return path_is_blocked(world.grid, is_occupied, path, along_m, ahead_m, radius_m);
}

// With as much room as there is a way for; stored routes that were found blocked are left closed while there is
// another.
PlanResult RouteDriver::ask_planner(const WorldView& world, BehaviourContext& orders) {
  PlanRequest request;
  request.from.pose = world.pose.T_map_robot;
  request.to = goal_;
  request.seed = seed_ + static_cast<std::uint64_t>(plans_);
  ++plans_;
  planned_s_ = world.time_s;
  for (const auto& [route, until_s] : closed_until_s_) request.closed.push_back(route);
  PlanResult result;
  for (const bool with_closed : {true, false}) {
    if (!with_closed && request.closed.empty()) break;
    if (!with_closed) request.closed.clear();
    for (const double room_m : kRooms_m) {
      request.radius_m = world.robot.radius_m + room_m;
      result = orders.plan(request);
      for (const RouteId route : result.blocked_routes) closed_until_s_[route] = world.time_s + kClosedFor_s;
      if (result.outcome == PlanOutcome::solved) return result;
      if (result.outcome == PlanOutcome::unknown_place || result.outcome == PlanOutcome::cancelled) return result;
    }
  }
  return result;
}

void RouteDriver::take_path(const std::vector<Point>& path, Leg leg) {
  path_ = path;
  segments_.clear();
  leg_ = leg;
  own_trust_.reset();
  follow_state_ = {0.0, follow_state_.turning};
  stop_doubting();
}

void RouteDriver::take_route(const PlanResult& result, const WorldView& world) {
  take_path(points_of(result.path), Leg::route);
  // Planners over cells end in the middle of one.
  const double cell_m = world.grid.cell_m();
  if (goal_.pose && !path_.empty() && (path_.back() - goal_.pose->position()).norm() < cell_m)
    path_.back() = goal_.pose->position();
  segments_ = result.segments;
  if (!path_.empty()) route_end_ = path_.back();
  const auto reached = std::find_if(result.landmarks.rbegin(), result.landmarks.rend(), [&](LandmarkId id) {
    return std::find(goal_.landmarks.begin(), goal_.landmarks.end(), id) != goal_.landmarks.end();
  });
  goal_landmark_ = reached == result.landmarks.rend() ? 0 : *reached;
}

Status RouteDriver::plan(const WorldView& world, BehaviourContext& orders) {
  if (world.time_s - planned_s_ < kPlansApart_s) return {Progress::running, "waiting to plan again"};
  if (plans_ >= kMaxPlans) return give_up(world);
  // The planner knows nothing of what has held the robot back there: from the second time on, a way round that.
  if (round_ >= 2 && round_ % 2 == 0 && plan_by_own_eyes(world, Trust::all)) {
    set_mode(Mode::travel, world.time_s);
    return {Progress::running, "going round what held it back"};
  }
  const PlanResult result = ask_planner(world, orders);
  if (result.outcome != PlanOutcome::solved) return no_plan(result, world, orders);
  take_route(result, world);
  set_mode(Mode::travel, world.time_s);
  return {Progress::running, "under way"};
}

std::optional<Point> RouteDriver::goal_point(const WorldView& world) const {
  if (goal_.pose) return goal_.pose->position();
  if (route_end_) return route_end_;
  for (const LandmarkId id : goal_.landmarks)
    if (const Landmark* landmark = world.graph.find(id)) return landmark->approach_pose().position();
  return std::nullopt;
}

// A way on the map as the near echoes correct it, that avoids where the robot was held back and may pass close to what
// is not known. What of the map is not trusted the live echoes tell, if it is real.
bool RouteDriver::plan_by_own_eyes(const WorldView& world, Trust trust) {
  const std::optional<Point> goal = goal_point(world);
  if (!goal) return false;
  for (const double room_m : {kSpaceClearance_m, kTightClearance_m}) {
    const double clearance_m = trust == Trust::squeezed ? kSqueezedRadius_m - world.robot.radius_m : room_m;
    const FreeSpace space = space_now(world, clearance_m, trust);
    std::vector<Point> path = space.path_to(space.cell_at(*goal));
    if (path.size() >= 2) {
      path.push_back(*goal);
      take_path(path, Leg::route);
      own_trust_ = trust;
      planned_s_ = world.time_s;
      doubt_as(trust, world);
      if (trust == Trust::squeezed) doubt_along_path(world);
      return true;
    }
    if (trust == Trust::squeezed) break;
  }
  return false;
}

Status RouteDriver::no_plan(const PlanResult& result, const WorldView& world, BehaviourContext& orders) {
  const std::string why = std::string(name_of(result.outcome)) + ": " + result.reason;
  const bool is_final = result.outcome == PlanOutcome::unknown_place || result.outcome == PlanOutcome::cancelled;
  if (!is_final && result.outcome == PlanOutcome::start_blocked && begin_escape(world)) {
    set_mode(Mode::travel, world.time_s);
    return {Progress::running, "making room"};
  }
  const bool may_explore = unknown_ways_ < kMaxUnknownWays;
  if (!is_final && (plan_by_own_eyes(world, Trust::all) || plan_by_own_eyes(world, Trust::no_specks) ||
                    (may_explore && plan_by_own_eyes(world, Trust::only_solid)))) {
    ++unknown_ways_;
    set_mode(Mode::travel, world.time_s);
    return {Progress::running, "under way by what it sees itself"};
  }
  if (!is_final && looks_ >= kLooksBeforeSqueezing && squeezes_ < kMaxNarrowGapTries &&
      plan_by_own_eyes(world, Trust::squeezed)) {
    ++squeezes_;
    set_mode(Mode::travel, world.time_s);
    return {Progress::running, "trying an opening that looks too narrow"};
  }
  if (!is_final && begin_look(result.outcome, world)) {
    orders.say("no way now (" + why + "): looks again at " + described(look_.at));
    set_mode(Mode::travel, world.time_s);
    return {Progress::running, "going to look at " + described(look_.at)};
  }
  return {Progress::failure, why + (tried_.empty() ? "" : "; " + tried_)};
}

// Too near to something to plan: a little further from it first.
bool RouteDriver::begin_escape(const WorldView& world) {
  if (escape_paths_ >= kMaxEscapes) return false;
  ++escape_paths_;
  std::vector<Point> path = space_now(world, kEscapeClearance_m, Trust::all).escape_path();
  if (path.size() < 2) path = space_now(world, kTightClearance_m, Trust::all).escape_path();
  if (path.size() < 2) return false;
  take_path(path, Leg::escape_path);
  tried_ = "made room " + std::to_string(escape_paths_) + " times";
  return true;
}

// Where the goal itself is blocked, from beside it: nothing else has to do with that.
bool RouteDriver::begin_look(PlanOutcome outcome, const WorldView& world) {
  const std::optional<Point> goal = goal_point(world);
  if (!goal || looks_ >= kMaxLooks) return false;
  if (outcome == PlanOutcome::goal_blocked && (goal_.pose || route_end_) && begin_look_at_goal(*goal, world))
    return true;
  if (outcome == PlanOutcome::goal_blocked && !beside_goal_.empty()) return false;
  const double stand_off_m = looks_ < kLooksBeforeAgain ? kStandOff_m : kStandOffNearer_m;
  const std::optional<LookoutRoute> way =
      lookout_route(space_now(world, kTightClearance_m, Trust::all), world.grid, world.pose.T_map_robot.position(),
                    *goal, looked_at_, stand_off_m);
  if (!way) return false;
  go_to_look(*way);
  looked_at_.push_back(way->at);
  return true;
}

// Walls are drawn thick where they have been seen from afar, and people leave traces: from right beside the goal it may
// be free. Each time from another place, then again: somebody may go on.
bool RouteDriver::begin_look_at_goal(const Point& goal, const WorldView& world) {
  const double within_m = world.robot.radius_m + kBesideGoal_m;
  for (const Trust trust : {Trust::all, Trust::no_specks, Trust::only_solid}) {
    const FreeSpace space = space_now(world, kTightClearance_m, trust);
    std::optional<Cell> beside = cell_beside(goal, within_m, space, beside_goal_);
    if (!beside) beside = cell_beside(goal, within_m, space, {});
    if (!beside) continue;
    go_to_look({goal, space.path_to(*beside)});
    doubt_as(trust, world);
    look_.at_most_s = kBesideGoalFor_s;
    look_.is_goal = true;
    looked_at_.push_back(goal);
    return true;
  }
  return false;
}

void RouteDriver::go_to_look(const LookoutRoute& way) {
  if (++looks_ == kLooksBeforeAgain + 1) looked_at_.clear();
  take_path(way.path, Leg::to_look);
  tried_ = "looked " + std::to_string(looks_) + " times whether the way is free again, last at " + described(way.at);
  look_ = {.at = way.at, .through = {}};
}

}  // namespace cairn::behaviours
