#include "framework/experiments/trials/goals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/config/coordinates.hpp"
#include "framework/experiments/trials/true_space.hpp"

namespace cairn {
namespace {

constexpr double kOff_rad = radians(15.0);
constexpr double kRobotCells_m = 0.35;  // less than what a wall leaves between its two sides
constexpr double kGoalCells_m = 0.08;
constexpr double kLook_s = 1.0;
constexpr double kUsualTolerance_m = 0.1;
const std::string kNearest = "nearest ";

// One place of a goal: a point, or beside any landmark of a category.
struct Target {
  Point at_m{0.0, 0.0};
  std::string category;
};

struct Goal {
  std::string text;
  std::vector<Target> targets;
  double tolerance_m = kUsualTolerance_m;
};

struct ActiveFault {
  double begin_s = 0.0;
  double end_s = 0.0;
  bool moves_pose = false;
};

std::vector<ActiveFault> faults_of(const Mission& mission) {
  std::vector<ActiveFault> faults;
  const ConfigValue* list = mission.config.sensor.config.find("faults");
  if (list == nullptr) return faults;
  constexpr Range kTime_s{0.0, 1e9};
  for (const ConfigValue& item : list->items) {
    const double at_s = config_detail::to_number(*item.find("at_s"), "at_s", kTime_s, "s");
    const ConfigValue* for_s = item.find("for_s");
    const bool is_kidnap = item.find("kidnap") != nullptr;
    const double lasts_s = is_kidnap          ? 0.0
                           : for_s == nullptr ? std::numeric_limits<double>::infinity()
                                              : config_detail::to_number(*for_s, "for_s", kTime_s, "s");
    const bool moves_pose = is_kidnap || item.find("slip") != nullptr || item.find("compass_jump_deg") != nullptr;
    faults.push_back({at_s, at_s + lasts_s, moves_pose});
  }
  return faults;
}

Target target_of(const ConfigValue& value) {
  if (const std::optional<Point> at_m = point_in(value, "places")) return {*at_m, ""};
  const std::string name = config_detail::to_text(value, "landmark");
  return {{0.0, 0.0}, name.starts_with(kNearest) ? name.substr(kNearest.size()) : name};
}

std::string text_of(const Target& target) {
  return target.category.empty() ? fmt::format("({:.2f}, {:.2f})", target.at_m.x(), target.at_m.y()) : target.category;
}

// Nothing for a leaf that is no goal.
std::optional<Goal> goal_of(const TreeNode& leaf, const Mission& mission) {
  const std::string& kind = leaf.choice.name;
  const ConfigValue& config = leaf.choice.config;
  Goal goal;
  if (kind == "return_home") {
    goal.targets = {{mission.config.start.at_m, ""}};
  } else if (const ConfigValue* places = config.find("places"); kind == "tour" || kind == "patrol") {
    if (places != nullptr)
      for (const ConfigValue& place : places->items) goal.targets.push_back(target_of(place));
  } else if (kind == "goto") {
    const ConfigValue* place = config.find("at_m") != nullptr ? config.find("at_m") : config.find("landmark");
    goal.targets = {target_of(place != nullptr ? *place : config)};
  } else {
    return std::nullopt;
  }
  if (const ConfigValue* tolerance = config.find("tolerance_m"))
    goal.tolerance_m = config_detail::to_number(*tolerance, "tolerance_m", {0.0, 100.0}, "m");
  goal.text = kind;
  for (const Target& target : goal.targets) goal.text += " " + text_of(target);
  return goal;
}

class Judge {
 public:
  Judge(const TrialsConfig& config, const TrialEvidence& evidence)
      : config_(config),
        evidence_(evidence),
        world_(*evidence.mission.world),
        space_(world_, evidence.mission.robot.radius_m + config.clearance_m),
        faults_(faults_of(evidence.mission)) {}

  [[nodiscard]] GoalVerdict judge(const TreeNode& leaf, const Goal& goal, const std::vector<const NodeRun*>& runs);

 private:
  using Moments = std::span<const TrialMoment>;
  [[nodiscard]] Moments during(double begin_s, double end_s) const;
  [[nodiscard]] bool is_true(const std::string& category, const Point& at_m) const;
  [[nodiscard]] std::vector<Point> places_of(const Target& target, const std::string& leaf) const;
  [[nodiscard]] double distance_to_m(const Target& target, const std::vector<Point>& places_m, const Point& p_m) const;
  [[nodiscard]] double missed_m(const Goal& goal, const std::string& leaf, Moments moments) const;
  [[nodiscard]] bool is_reachable(const Target& target, Moments moments);
  [[nodiscard]] bool is_mapped(const Target& target, const std::string& leaf) const;

  const TrialsConfig& config_;
  const TrialEvidence& evidence_;
  const World& world_;
  TrueSpace space_;
  std::vector<ActiveFault> faults_;
};

Judge::Moments Judge::during(double begin_s, double end_s) const {
  const std::vector<TrialMoment>& all = evidence_.record.moments();
  const auto begin = std::ranges::lower_bound(all, begin_s, {}, &TrialMoment::time_s);
  const auto end = std::ranges::upper_bound(begin, all.end(), end_s, {}, &TrialMoment::time_s);
  return {begin, end};
}

bool Judge::is_true(const std::string& category, const Point& at_m) const {
  return std::ranges::any_of(world_.objects, [&](const WorldObject& object) {
    return object.category == category && (object.T_map_object.position() - at_m).norm() <= config_.off_m;
  });
}

// Where the robot should be: any of these.
std::vector<Point> Judge::places_of(const Target& target, const std::string& leaf) const {
  if (target.category.empty()) return {target.at_m};
  std::vector<Point> places_m;
  for (const KnownLandmark& known : evidence_.record.landmarks_at_end(leaf))
    if (known.category == target.category && is_true(known.category, known.at_m)) places_m.push_back(known.access_m);
  return places_m;
}

// From a robot's true place. A planner may end beside a landmark elsewhere than the map says that one stands.
double Judge::distance_to_m(const Target& target, const std::vector<Point>& places_m, const Point& p_m) const {
  double way_m = std::numeric_limits<double>::infinity();
  for (const Point& place_m : places_m) way_m = std::min(way_m, (place_m - p_m).norm());
  if (target.category.empty() || places_m.empty()) return way_m;
  for (const WorldObject& object : world_.objects)
    if (object.category == target.category)
      way_m = std::min(
          way_m, object.contour.signed_distance(inverse(object.T_map_object) * p_m) - evidence_.mission.robot.radius_m);
  return way_m;
}

// How much farther off than it may be: of one place at the end, of several at the best time for each. Negative: there.
double Judge::missed_m(const Goal& goal, const std::string& leaf, Moments moments) const {
  if (moments.empty()) return std::numeric_limits<double>::infinity();
  const Moments counting = goal.targets.size() == 1 ? moments.last(1) : moments;
  double worst_m = -std::numeric_limits<double>::infinity();
  for (const Target& target : goal.targets) {
    double nearest_m = std::numeric_limits<double>::infinity();
    const std::vector<Point> places_m = places_of(target, leaf);
    for (const TrialMoment& moment : counting)
      nearest_m = std::min(nearest_m, distance_to_m(target, places_m, moment.T_map_robot.position()));
    worst_m = std::max(worst_m, nearest_m);
  }
  return worst_m - config_.off_m - goal.tolerance_m;
}

bool Judge::is_reachable(const Target& target, Moments moments) {
  TrueSpace::Cells to;
  if (target.category.empty()) {
    if (space_.has_room(target.at_m)) to = space_.cells_near(target.at_m, kGoalCells_m);
  } else {
    for (const WorldObject& object : world_.objects) {
      if (object.category != target.category) continue;
      const TrueSpace::Cells beside =
          space_.cells_beside(object, evidence_.mission.robot.radius_m + config_.off_m + kUsualTolerance_m);
      to.insert(to.end(), beside.begin(), beside.end());
    }
  }
  if (to.empty()) return false;
  double next_s = -1.0;
  for (const TrialMoment& moment : moments) {
    if (moment.time_s < next_s) continue;
    next_s = moment.time_s + kLook_s;
    const TrueSpace::Cells from = space_.cells_near(moment.T_map_robot.position(), kRobotCells_m);
    if (space_.joined(from, to, space_.doors_at(moment.time_s))) return true;
  }
  return false;
}

bool Judge::is_mapped(const Target& target, const std::string& leaf) const {
  if (!target.category.empty()) return !places_of(target, leaf).empty();
  if (evidence_.grid == nullptr) return false;
  const OccupancyGrid& grid = *evidence_.grid;
  const int reach = static_cast<int>(evidence_.mission.robot.radius_m / grid.cell_m());
  int known = 0;
  int cells = 0;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      ++cells;
      known += grid.state(grid.cell_at(target.at_m) + Cell{dx, dy}) == CellState::unknown ? 0 : 1;
    }
  return 2 * known >= cells;
}

GoalVerdict Judge::judge(const TreeNode& leaf, const Goal& goal, const std::vector<const NodeRun*>& runs) {
  GoalVerdict verdict;
  verdict.path = leaf.path;
  verdict.goal = goal.text;
  verdict.begin_s = runs.front()->begin_s;
  verdict.end_s = runs.back()->end_s;
  const Moments moments = during(verdict.begin_s, verdict.end_s);
  const auto report = std::ranges::find(evidence_.result.nodes, leaf.path, &NodeReport::path);
  if (report != evidence_.result.nodes.end()) verdict.reason = report->status.reason;
  const RunEnd end = runs.back()->end;
  if (end == RunEnd::success) {
    verdict.missed_m = std::max(0.0, missed_m(goal, leaf.path, moments));
    verdict.end = verdict.missed_m > 0.0 ? GoalEnd::false_success : GoalEnd::reached;
  } else {
    verdict.end = end == RunEnd::failure ? GoalEnd::failed : GoalEnd::halted;
  }
  verdict.is_reachable =
      std::ranges::all_of(goal.targets, [&](const Target& target) { return is_reachable(target, moments); });
  verdict.is_mapped =
      std::ranges::all_of(goal.targets, [&](const Target& target) { return is_mapped(target, leaf.path); });
  verdict.is_struck = std::ranges::any_of(moments, &TrialMoment::is_empty);
  bool moved_pose = false;
  for (const ActiveFault& fault : faults_) {
    if (fault.begin_s > verdict.end_s) continue;
    verdict.is_struck = verdict.is_struck || fault.end_s >= verdict.begin_s;
    moved_pose = moved_pose || fault.moves_pose;
  }
  const auto is_off = [&](const TrialMoment& m) { return m.off_m > config_.off_m || m.off_rad > kOff_rad; };
  verdict.is_displaced = moved_pose && std::ranges::any_of(moments, is_off);
  return verdict;
}

}  // namespace

std::string_view name_of(GoalEnd end) {
  constexpr std::array<std::string_view, 4> kNames{"reached", "false_success", "failed", "halted"};
  return kNames[static_cast<std::size_t>(end)];
}

std::vector<GoalVerdict> judge_goals(const TrialsConfig& config, const TrialEvidence& evidence) {
  Judge judge(config, evidence);
  std::vector<GoalVerdict> verdicts;
  for (const TreeNode* leaf : behaviours_of(evidence.mission.steps)) {
    const std::optional<Goal> goal = goal_of(*leaf, evidence.mission);
    if (!goal) continue;
    std::vector<const NodeRun*> runs;
    for (const NodeRun& run : evidence.result.node_runs.runs())
      if (run.path == leaf->path) runs.push_back(&run);
    if (!runs.empty()) verdicts.push_back(judge.judge(*leaf, *goal, runs));
  }
  return verdicts;
}

}  // namespace cairn
