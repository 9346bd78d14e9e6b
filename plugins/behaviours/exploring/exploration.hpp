// One run of exploring, from its first tick to its end; ticked after that it explores on with what it remembers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/behaviours/exploring/blockage_count.hpp"
#include "plugins/behaviours/exploring/explore.hpp"
#include "plugins/behaviours/exploring/passages/passage_drive.hpp"
#include "plugins/behaviours/exploring/task_chooser.hpp"
#include "plugins/behaviours/exploring/task_follower.hpp"
#include "plugins/behaviours/exploring/travelled.hpp"
#include "plugins/behaviours/places/map_watch.hpp"

namespace cairn::behaviours {

class Exploration {
 public:
  Exploration(const ExploreConfig& config, const WorldView& world);

  Status tick(const WorldView& world, BehaviourContext& context);
  // Whether the last tick ended it because nothing was left, openings that it did not get through aside.
  [[nodiscard]] bool has_nothing_left() const { return has_nothing_left_; }
  // As openings.hpp, on the map as it sees it.
  [[nodiscard]] std::optional<Point> room_out_of_reach(const WorldView& world, const std::vector<Point>& done) const {
    return chooser_.room_out_of_reach(world, done);
  }

 private:
  enum class Mode { look_around, travel, face, back_off, passage };

  Status look_around(const WorldView& world, BehaviourContext& context);
  Status travel(const WorldView& world, BehaviourContext& context);
  Status face(const WorldView& world, BehaviourContext& context);
  Status back_off(const WorldView& world, BehaviourContext& context);
  Status pass(const WorldView& world, BehaviourContext& context);

  void begin_here(const WorldView& world);
  void begin_in_new_map(const WorldView& world, const MapMove* move);
  void set_mode(Mode mode, double time_s);
  [[nodiscard]] bool is_on_orbit(const WorldView& world) const;
  [[nodiscard]] bool needs_choice(const WorldView& world) const;
  [[nodiscard]] bool choose(const WorldView& world, BehaviourContext& context);
  Status nothing_left(const WorldView& world, BehaviourContext& context);
  void arrive(const WorldView& world);
  void begin_passage(const WorldView& world);
  void end_facing(const WorldView& world, BehaviourContext& context);
  Status get_unstuck(const WorldView& world, BehaviourContext& context);
  Status turn_back(const WorldView& world);
  [[nodiscard]] Status finished(const WorldView& world);
  [[nodiscard]] Status explored(const WorldView& world);
  [[nodiscard]] Status cannot_get_away() const;
  [[nodiscard]] std::string summary(const WorldView& world) const;

  ExploreConfig config_;
  TaskChooser chooser_;
  TaskFollower follower_;
  PassageDrive drive_;
  BlockageCount blockages_;
  BackUp back_up_;
  Travelled travelled_;
  MapWatch map_watch_;
  std::optional<ExploreTask> task_;
  Mode mode_ = Mode::travel;
  bool has_nothing_left_ = false;
  double begun_s_;
  double mode_since_s_ = 0.0;
  double last_tick_s_ = -1e9;
  double chosen_s_ = 0.0;
  double faced_s_ = 0.0;
  bool is_faced_ = false;            // once, since it arrived: it sweeps
  double looked_around_at_m_ = 0.0;  // of the distance driven
  double arrived_at_m_ = -1.0;       // the same
  double turned_back_at_m_ = -1e9;   // the same
  Point announced_{1e9, 1e9};        // the object of the last event
};

}  // namespace cairn::behaviours
