#include "planners/hybrid/symbolic_path.hpp"

#include <algorithm>

namespace cairn {
namespace {

bool is_pose(const GoalPlace& goal) {
  return goal.landmark == 0;
}

// The landmarks and open routes without their trajectories, which the search does not read.
LandmarkGraph bare_copy(const LandmarkGraph& graph, const std::set<RouteId>& blocked) {
  LandmarkGraph bare;
  for (const auto& [id, landmark] : graph.landmarks()) {
    Landmark copy;
    copy.id = id;
    copy.T_map_landmark = landmark.T_map_landmark;
    bare.add(std::move(copy));
  }
  for (const auto& [id, route] : graph.routes()) {
    if (route.closed || blocked.contains(id)) continue;
    Route copy;
    copy.id = id;
    copy.from = route.from;
    copy.to = route.to;
    copy.cost_m = route.cost_m;
    bare.add_route(std::move(copy));
  }
  return bare;
}

std::set<LandmarkId> joined_landmarks(const LandmarkGraph& graph) {
  std::set<LandmarkId> joined;
  for (const auto& [id, route] : graph.routes()) joined.insert({route.from, route.to});
  return joined;
}

// The graph with the request's ends in it, and what is not of the original graph.
struct JoinedGraph {
  LandmarkGraph graph;
  LandmarkId first_extra_landmark = 0;
  RouteId first_extra_route = 0;
  PlanRequest request;
};

class Joiner {
 public:
  Joiner(const SymbolicQuery& query, const std::set<RouteId>& blocked)
      : query_(query), joined_(joined_landmarks(query.world.graph)) {
    result_.graph = bare_copy(query.world.graph, blocked);
    result_.first_extra_landmark = next_id(query.world.graph.landmarks());
    result_.first_extra_route = next_id(query.world.graph.routes());
    next_landmark_ = result_.first_extra_landmark;
    next_route_ = result_.first_extra_route;
  }

  JoinedGraph joined() {
    if (query_.start.landmark != 0) {
      result_.request.from.landmarks = {query_.start.landmark};
    } else {
      join_start();
    }
    for (const GoalPlace& goal : query_.goals) {
      if (is_pose(goal)) {
        join_goal(goal);
      } else {
        result_.request.to.landmarks.push_back(goal.landmark);
      }
    }
    return std::move(result_);
  }

 private:
  template <class Map>
  static std::int64_t next_id(const Map& map) {
    return map.empty() ? 1 : map.rbegin()->first + 1;
  }

  LandmarkId add_place(const Pose2& pose) {
    Landmark place;
    place.id = next_landmark_++;
    place.T_map_landmark = pose;
    return result_.graph.add(std::move(place));
  }
  void add_mile(LandmarkId from, LandmarkId to, double travel_m) {
    Route mile;
    mile.id = next_route_++;
    mile.from = from;
    mile.to = to;
    mile.cost_m = query_.travel_weight * travel_m;
    result_.graph.add_route(std::move(mile));
  }

  // Joins a place to every landmark that has routes and that travel reaches.
  template <class Add>
  void join(const TravelField& travel, Add add) {
    const DiscSpace& space = *query_.start.space;
    const auto reached = [&](Cell cell) { return travel.reaches(cell); };
    for (const LandmarkId id : joined_) {
      const auto stand = standing_place(space, *query_.world.graph.find(id), query_.radius_m, reached);
      if (stand) add(id, travel.cost_m(space.field().cell_at(stand->position())));
    }
  }
  void join_start() {
    const LandmarkId start = add_place(query_.start.pose);
    result_.request.from.landmarks = {start};
    join(query_.travel_from_start, [&](LandmarkId id, double travel_m) { add_mile(start, id, travel_m); });
  }
  void join_goal(const GoalPlace& goal) {
    const LandmarkId place = add_place(goal.pose);
    result_.request.to.landmarks.push_back(place);
    const TravelField travel = query_.start.space->travel_at_most(goal.pose.position(), query_.radius_m);
    join(travel, [&](LandmarkId id, double travel_m) { add_mile(id, place, travel_m); });
  }

  const SymbolicQuery& query_;
  std::set<LandmarkId> joined_;
  JoinedGraph result_;
  LandmarkId next_landmark_ = 1;
  RouteId next_route_ = 1;
};

std::size_t goal_index(const std::vector<GoalPlace>& goals, LandmarkId reached) {
  for (std::size_t i = 0; i < goals.size(); ++i)
    if (goals[i].landmark == reached) return i;
  for (std::size_t i = 0; i < goals.size(); ++i)
    if (is_pose(goals[i])) return i;
  return 0;
}

// Back from the joined graph: without the added places and miles, and with miles at their true length.
SymbolicPath path_of(const PlanResult& found, const JoinedGraph& joined, const SymbolicQuery& query) {
  SymbolicPath path;
  path.goal = goal_index(query.goals, found.landmarks.back());
  for (const LandmarkId id : found.landmarks)
    if (id < joined.first_extra_landmark) path.landmarks.push_back(id);
  for (const RouteId id : found.routes) {
    const double cost_m = joined.graph.find_route(id)->cost_m;
    const bool mile = id >= joined.first_extra_route;
    if (!mile) path.routes.push_back(id);
    path.cost_m += mile ? cost_m / query.travel_weight : cost_m;
  }
  return path;
}

// Landmarks at both ends and nothing blocked: the graph as it is.
std::optional<PlanRequest> request_without_joining(const SymbolicQuery& query, const std::set<RouteId>& blocked) {
  if (query.start.landmark == 0 || !blocked.empty()) return std::nullopt;
  PlanRequest request;
  request.from.landmarks = {query.start.landmark};
  for (const GoalPlace& goal : query.goals) {
    if (is_pose(goal)) return std::nullopt;
    request.to.landmarks.push_back(goal.landmark);
  }
  return request;
}

SymbolicAnswer answer_of(const PlanResult& found) {
  SymbolicAnswer answer;
  answer.settled = found.settled;
  if (found.outcome == PlanOutcome::cancelled || found.outcome == PlanOutcome::out_of_budget)
    answer.stopped = found.outcome;
  return answer;
}

}  // namespace

SymbolicAnswer symbolic_path(const SymbolicQuery& query, const std::set<RouteId>& blocked, const Planner& graph_planner,
                             const Budget& budget) {
  const WorldView& world = query.world;
  if (world.graph.routes().empty()) return {};
  if (const auto request = request_without_joining(query, blocked)) {
    const PlanResult found = graph_planner.plan(*request, world, budget);
    SymbolicAnswer answer = answer_of(found);
    if (found.outcome == PlanOutcome::solved && !found.routes.empty())
      answer.path = {found.landmarks, found.routes, found.cost_m, goal_index(query.goals, found.landmarks.back())};
    return answer;
  }
  const JoinedGraph joined = Joiner(query, blocked).joined();
  const PlanResult found = graph_planner.plan(
      joined.request,
      {world.grid, joined.graph, world.robot, world.pose, world.time_s, world.observation, world.held_back_ratio},
      budget);
  SymbolicAnswer answer = answer_of(found);
  if (found.outcome != PlanOutcome::solved) return answer;
  SymbolicPath path = path_of(found, joined, query);
  if (!path.routes.empty()) answer.path = std::move(path);
  return answer;
}

}  // namespace cairn
