// Goes to a landmark or a place by the mission's planner, and faces it.
//
// Plans again when it is held back or when something turns up on the path; gives up with the planner's
// outcome and sentence.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/held_back.hpp"
#include "plugins/behaviours/path_follower.hpp"

namespace cairn::behaviours {

struct GoToConfig {
  ConfigValue landmark;  // text: `L3`, a name, or `nearest CATEGORY`
  std::optional<Point> at_m;
  std::optional<double> angle_rad;
  double tolerance_m = 0.1;
  double speed_mps = 0.25;
  double at_most_s = 900.0;

  static void describe(Fields<GoToConfig>& fields);
};

// The landmarks that a name stands for; when there are none, `unknown` says so, naming what there is.
struct NamedLandmarks {
  std::vector<LandmarkId> ids;
  std::string unknown;
};
[[nodiscard]] NamedLandmarks landmarks_named(const std::string& name, const LandmarkGraph& graph);

class GoTo : public Behaviour {
 public:
  // Throws ConfigError unless exactly one of landmark and at_m is given.
  GoTo(const GoToConfig& config, std::uint64_t seed);

  Status tick(const WorldView& world, Orders& orders) override;
  void halt() override;

 private:
  enum class Mode { plan, travel, back_off, face };

  Status plan(const WorldView& world, Orders& orders);
  Status travel(const WorldView& world, Orders& orders);
  Status back_off(const WorldView& world, Orders& orders);
  Status face(const WorldView& world, Orders& orders);

  [[nodiscard]] Place goal_of(const NamedLandmarks& named) const;
  Status begin_path(const WorldView& world, const PlanResult& result);
  Status plan_again(const WorldView& world, Orders& orders, const std::string& why);
  [[nodiscard]] std::string destination(const WorldView& world) const;

  GoToConfig config_;
  std::string landmark_name_;
  std::uint64_t seed_;
  Mode mode_ = Mode::plan;
  std::optional<double> begun_s_;
  double mode_since_s_ = 0.0;
  double planned_s_ = 0.0;
  int plans_ = 0;
  int ways_out_ = 0;
  bool on_way_out_ = false;
  LandmarkId reached_ = 0;  // the landmark that the plan ends at; 0: a place
  std::vector<Point> path_;
  FollowState follow_state_;
  Point backed_from_{0.0, 0.0};
  Twist wanted_;
  HeldBackWatch watch_;
};

}  // namespace cairn::behaviours
