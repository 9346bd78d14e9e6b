// A tiny host for behaviours: a disc that obeys at once, with a perfect pose, in a world drawn in
// ASCII; the grid is revealed by line of sight.
//
//   #  solid        .  free        R  free, the robot starts here, looking right
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/behaviour.hpp"
#include "plugins/pursuit_dwa/pursuit_dwa.hpp"

namespace cairn::behaviours {

struct FakeHostSettings {
  double character_m = 0.1;  // side of a drawn square
  double cell_m = 0.05;
  double sight_m = 2.0;
  bool all_known = false;  // the grid is complete from the start
};

class FakeHost : public BehaviourContext {
 public:
  explicit FakeHost(const std::string& drawing, const FakeHostSettings& settings = {});

  void drive(const Twist& wanted) override { wanted_ = wanted; }
  // By `controller`, pursuit_dwa unless set.
  ControlResult control(const ControlRequest& request) override;
  PlanResult plan(const PlanRequest& request) override;
  Status save(const std::string& file_name) override {
    saved.push_back(file_name);
    return {StepState::success, "saved " + file_name};
  }
  Status answer(const PlanQuestion& question, const std::string& file_name) override {
    asked.push_back(question);
    return {StepState::success, "answered into " + file_name};
  }
  Status write(const OutputText& output) override {
    if (!output.append) written[output.file_name].clear();
    written[output.file_name] += output.text;
    return {StepState::success, "wrote " + output.file_name};
  }
  void report(const std::string& sentence) override { said.push_back(sentence); }
  std::optional<Place> input(const std::string& name) override {
    const auto found = values.find(name);
    return found == values.end() ? std::nullopt : std::optional(found->second);
  }
  void output(const std::string& name, const Place& place) override { values[name] = place; }
  Status name_landmark(LandmarkId id, const std::string& name) override {
    if (graph.find(id) == nullptr) return {StepState::failure, "no such landmark"};
    graph.find(id)->name = name;
    return {StepState::success, "L" + std::to_string(id) + " is now " + name};
  }
  Status name_cluster(const std::string& cluster, const std::string& name) override {
    named_clusters.push_back(cluster + " " + name);
    return {StepState::success, cluster + " is now " + name};
  }

  std::optional<Order> next_order() override {
    if (orders.empty()) return std::nullopt;
    Order order = std::move(orders.front());
    orders.pop_front();
    return order;
  }
  void answer_order(const Status& answer) override { answers.push_back(answer); }

  // Ticks until the behaviour ends or the time is up (then its status is still running).
  Status run(Behaviour& behaviour, double at_most_s);
  Status tick(Behaviour& behaviour);
  // Ticks until it says how long it still takes; none when it ends or the time is up before.
  std::optional<double> first_left_s(Behaviour& behaviour, double at_most_s);

  [[nodiscard]] WorldView view(const Observation* seen) const;

  // The map is drawn anew, with all places elsewhere by so much, in whole cells; the robot and landmarks come along.
  void move_map(const Point& by_m);

  [[nodiscard]] bool is_solid(const Point& p_map) const;
  // From the robot's centre to the nearest solid square.
  [[nodiscard]] double distance_to_solid_m() const;
  // The grid and the driven path, for failures.
  [[nodiscard]] std::string picture() const;
  void solidify(const Point& p, bool solid = true);

  RobotModel robot;
  LandmarkGraph graph;
  OccupancyGrid grid;
  Pose2 T_map_robot;
  Pose2 T_map_start;  // as the drawing has it
  // What the sensors see in a tick; nothing by default.
  std::function<Observation(const FakeHost&)> observe;
  PoseTrust trust = PoseTrust::tracking;
  std::uint64_t map_moves = 0;
  std::optional<MapMove> last_map_move;
  double time_s = 0.0;
  double speed_reduction_ratio = 0.0;
  // What the collision monitor lets through; all of it by default.
  std::function<Twist(const Pose2& T_map_robot, const Twist& wanted)> collision_monitor;
  // Answers plan(); by default the shortest path over the grid.
  std::function<PlanResult(const PlanRequest&)> planner;

  std::shared_ptr<Controller> controller = std::make_shared<pursuit_dwa::PursuitDwa>(pursuit_dwa::PursuitDwaConfig{});
  std::map<std::string, Place> values;  // that steps hand over
  const Hierarchies* hierarchies = nullptr;
  std::vector<std::string> named_clusters;

  std::vector<Pose2> driven;  // every tick
  std::vector<PlanRequest> planned;
  std::vector<std::string> saved;
  std::vector<std::string> said;
  std::vector<PlanQuestion> asked;
  std::deque<Order> orders;  // that come
  std::vector<Status> answers;
  std::map<std::string, std::string> written;  // text by file name
  double driven_m = 0.0;
  double nearest_solid_m = 1e9;  // over the whole run

 private:
  void reveal();
  void move(const Twist& twist);
  [[nodiscard]] bool can_stand(const Point& p) const;
  void mark(Cell cell);

  FakeHostSettings settings_;
  std::vector<std::string> rows_;  // from the top
  Point drawn_from_m_{0.0, 0.0};   // the drawing's lower left corner
  Twist wanted_;
  int ticks_ = 0;
};

}  // namespace cairn::behaviours
