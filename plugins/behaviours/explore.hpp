// Explores the reachable space and looks closer at what it finds.
//
// Ends with success when the wanted share is known and nothing is left to look closer at, when nothing
// in reach is left, or when its time is up; with failure only when the robot cannot move.
// The map is searched at most twice a second; every other
// tick costs microseconds. Deterministic.
#pragma once

#include <memory>
#include <optional>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/explore_progress.hpp"

namespace cairn::behaviours {

struct ExploreConfig {
  double until_known_ratio = 0.95;
  double at_most_s = 900.0;
  double clearance_m = 0.1;
  double look_closer_m = 0.9;
  double lap_distance_m = 0.55;
  double largest_object_m = 1.5;
  bool second_look = true;
  double smallest_frontier_m = 0.3;
  double speed_mps = 0.2;
  double lap_speed_mps = 0.1;

  static void describe(Fields<ExploreConfig>& fields);
};

class Exploration;

class Explore : public Behaviour {
 public:
  explicit Explore(const ExploreConfig& config);
  ~Explore() override;

  Status tick(const WorldView& world, Orders& orders) override;
  void halt() override;

 private:
  ExploreConfig config_;
  std::unique_ptr<Exploration> run_;  // from the first tick on
  double begun_s_ = 0.0;
  std::optional<ExploreProgress> progress_;
};

}  // namespace cairn::behaviours
