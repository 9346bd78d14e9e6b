// One run of exploring, from its first tick to its end; ticked after that it explores on with what it remembers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/behaviours/driving/commanded_motion.hpp"
#include "plugins/behaviours/driving/followed_path.hpp"
#include "plugins/behaviours/driving/local_obstacles.hpp"
#include "plugins/behaviours/driving/near_echoes.hpp"
#include "plugins/behaviours/driving/progress_checker.hpp"
#include "plugins/behaviours/exploring/explore.hpp"
#include "plugins/behaviours/exploring/explore_tasks.hpp"

namespace cairn::behaviours {

class Exploration {
 public:
  Exploration(const ExploreConfig& config, const WorldView& world);

  Status tick(const WorldView& world, BehaviourContext& context);
  // As openings.hpp, on the map as it sees it.
  [[nodiscard]] std::optional<Point> room_out_of_reach(const WorldView& world, const std::vector<Point>& done) const;

 private:
  enum class Mode { look_around, travel, face, back_off };

  Status look_around(const WorldView& world, BehaviourContext& context);
  Status travel(const WorldView& world, BehaviourContext& context);
  Status face(const WorldView& world, BehaviourContext& context);
  Status back_off(const WorldView& world, BehaviourContext& context);

  void begin_here(const WorldView& world);
  void remember(const WorldView& world);
  void set_mode(Mode mode, double time_s);
  void drive(const Twist& wanted, const WorldView& world, BehaviourContext& context);
  ControlResult follow_path(const WorldView& world, BehaviourContext& context);
  // Which part of the map is searched, and how much room is kept.
  struct Search {
    double within_m = 8.0;
    double clearance_m = 0.1;
  };
  [[nodiscard]] FreeSpace space_now(const WorldView& world, const Search& search) const;
  [[nodiscard]] bool is_shut_in(const WorldView& world) const;
  // Whether keeping less room gets the robot to more of the map.
  [[nodiscard]] bool leads_on(const WorldView& world, const Search& tight) const;
  [[nodiscard]] bool choose_by(const Search& search, const WorldView& world, const std::optional<ExploreTask>& before);
  [[nodiscard]] bool is_blocked(const WorldView& world) const;
  [[nodiscard]] bool is_on_orbit(const WorldView& world) const;
  [[nodiscard]] bool needs_choice(const WorldView& world) const;
  [[nodiscard]] bool choose(const WorldView& world, BehaviourContext& context);
  [[nodiscard]] bool choose_again(const WorldView& world, const std::optional<ExploreTask>& before);
  [[nodiscard]] bool choose_opening(const WorldView& world);
  [[nodiscard]] bool is_to_be_faced() const;
  Status nothing_left(const WorldView& world, BehaviourContext& context);
  void arrive(const WorldView& world);
  Status get_unstuck(const WorldView& world, BehaviourContext& context);
  [[nodiscard]] Status finished(const WorldView& world) const;
  [[nodiscard]] Status cannot_get_away() const;
  [[nodiscard]] std::string summary(const WorldView& world) const;

  ExploreConfig config_;
  Search search_;  // of the last choice
  TaskSettings settings_;
  Mode mode_ = Mode::travel;
  double begun_s_;
  double mode_since_s_ = 0.0;
  double last_tick_s_ = -1e9;
  double chosen_s_ = 0.0;
  double faced_s_ = 0.0;
  double turned_rad_ = 0.0;
  double looked_around_at_m_ = 0.0;  // of the distance driven
  double driven_m_ = 0.0;
  double driven_when_stuck_m_ = 0.0;
  double driven_when_arrived_m_ = -1.0;
  int stuck_in_a_row_ = 0;
  Pose2 last_pose_;
  Point said_about_{1e9, 1e9};
  std::optional<ExploreTask> task_;
  FollowedPath path_;  // of the task
  Twist wanted_;       // of the last tick
  ProgressChecker progress_;
  BackUp back_up_;
  std::vector<Point> failed_lookouts_;
  NearEchoes near_echoes_;
  LocalObstacles obstacles_;
  CommandedMotion motion_;
  ExploreMemory memory_;
};

}  // namespace cairn::behaviours
