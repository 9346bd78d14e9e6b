// The host's side of a behaviour: a robot that obeys its commands in the room of fixtures.hpp.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/behaviour.hpp"

namespace cairn::conformance {

class BehaviourHost : public BehaviourContext {
 public:
  BehaviourHost();

  void drive(const Twist& wanted) override;
  // Straight to a point of the path that is a little ahead; obstacles do not count.
  ControlResult control(const ControlRequest& request) override;
  PlanResult plan(const PlanRequest& request) override;
  Status save(const std::string& file_name) override;
  Status answer(const PlanQuestion& question, const std::string& file_name) override;
  Status write(const OutputText& output) override;
  void report(const std::string& sentence) override;
  std::optional<Place> input(const std::string& name) override;
  void output(const std::string& name, const Place& place) override;
  Status name_landmark(LandmarkId id, const std::string& name) override;
  Status name_cluster(const std::string& cluster, const std::string& name) override;
  std::optional<Order> next_order() override { return std::nullopt; }  // nobody orders anything
  void answer_order(const Status& answer) override;

  // One tick: the behaviour, then the motion it asked for, then the clock.
  Status tick(Behaviour& behaviour);
  // Until the behaviour ends or the time is up; then the status is still running.
  Status run(Behaviour& behaviour, double at_most_s);

  // Everything asked for and answered so far, a line each: equal texts are equal runs.
  [[nodiscard]] const std::string& record() const { return record_; }
  [[nodiscard]] const std::string& fault() const { return fault_; }  // the first order that is not finite

  RobotModel robot;
  LandmarkGraph graph;  // landmark 1, a square
  OccupancyGrid grid;   // the whole room, known
  Pose2 T_map_robot;
  double time_s = 0.0;
  double tick_s = 0.05;
  bool sees = true;                // WorldView::observation is not null
  bool sees_oddly = false;         // among its readings are those of odd_readings()
  bool holds_back = false;         // the stop layer lets nothing through
  bool finds_no_route = false;     // plan() answers no_route
  bool finds_empty_paths = false;  // plan() answers solved with no pose
  // > 0: the map is exchanged each time after so many ticks: for one that lies a little elsewhere, as last_map_move
  // says, or as nobody knows.
  int ticks_to_exchange = 0;
  bool knows_map_moves = true;

 private:
  void exchange_map();

  OccupancyGrid room_;
  OccupancyGrid exchanged_;  // the grid, in another place of memory
  bool is_exchanged_ = false;
  int ticks_ = 0;
  std::uint64_t map_moves_ = 0;
  std::optional<MapMove> last_map_move_;
  Twist wanted_;
  double speed_reduction_ratio_ = 0.0;
  std::map<std::string, Place> values_;
  std::string record_;
  std::string fault_;
};

}  // namespace cairn::conformance
