// Explores the reachable space and looks closer at what it finds.
//
// Ends with success when the wanted share is known and nothing is left to look closer at, when nothing
// in reach is left, or when its time is up; with failure when the robot cannot move, or when it has not entered
// openings that it should fit through and less than the wanted share is known.
// The map is searched at most twice a second; every other
// tick costs microseconds. Deterministic.
#pragma once

#include <memory>
#include <optional>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/driving/settings.hpp"
#include "plugins/behaviours/exploring/explore_progress.hpp"
#include "plugins/behaviours/exploring/settings.hpp"
#include "plugins/behaviours/lookouts/look_closer.hpp"

namespace cairn::behaviours {

struct ExploreConfig {
  double until_known_ratio = 0.95;
  double at_most_s = 900.0;
  double clearance_m = 0.1;
  double look_closer_m = 0.9;
  double orbit_distance_m = 0.55;
  double largest_object_m = 1.5;
  bool second_look = true;
  double smallest_frontier_m = 0.3;
  double gain_m = 0.0;
  double speed_mps = 0.2;
  double orbit_speed_mps = 0.1;
  ObjectSettings object;
  ExploringSettings exploring;
  DrivingSettings driving;

  static void describe(Fields<ExploreConfig>& fields);
  // All but when it ends: of a config that derives from it.
  template <class Config>
  static void describe_exploring(Fields<Config>& fields) {
    using C = Config;
    fields.number("clearance_m", &C::clearance_m, {0.0, 2.0}, "m",
                  "kept between the robot's edge and everything occupied");
    fields.number("look_closer_m", &C::look_closer_m, {0.0, 5.0}, "m",
                  "every edge is passed within this distance and every free-standing object circled; 0: neither");
    fields.number("orbit_distance_m", &C::orbit_distance_m, {0.1, 5.0}, "m",
                  "from the edge of an object to the robot's centre on an orbit");
    fields.number("largest_object_m", &C::largest_object_m, {0.1, 20.0}, "m", "what is longer is a wall: no orbits");
    fields.flag("second_look", &C::second_look,
                "when all is seen, free-standing objects that are no known landmark are circled once more");
    fields.number("smallest_frontier_m", &C::smallest_frontier_m, {0.0, 10.0}, "m", "shorter frontiers are left alone");
    fields.number("gain_m", &C::gain_m, {0.0, 100.0}, "m",
                  "a frontier may be so much further off for each time that the unknown area in sight from there is e "
                  "times as large (1 / lambda of Gonzalez-Banos and Latombe 2002); 0: the nearest frontier first");
    fields.number("speed_mps", &C::speed_mps, {0.01, 5.0}, "m/s", "top speed, within the robot's own limits");
    fields.number("orbit_speed_mps", &C::orbit_speed_mps, {0.01, 5.0}, "m/s",
                  "the same on an orbit: slower means more readings, and no more error of the odometry");
    fields.group("object", static_cast<ObjectSettings C::*>(&C::object), "what is an object that stands free");
    fields
        .group("exploring", static_cast<ExploringSettings C::*>(&C::exploring),
               "how it chooses what to do next, and what it does when it is blocked")
        .shared = "exploring";
    fields
        .group("driving", static_cast<DrivingSettings C::*>(&C::driving),
               "how it follows paths and what it takes for an obstacle")
        .shared = "driving";
  }
};

class Exploration;

class Explore : public Behaviour {
 public:
  explicit Explore(const ExploreConfig& config);
  ~Explore() override;

  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;
  // Whether it has just ended because nothing was left to explore, though it may not have got through every opening.
  [[nodiscard]] bool has_nothing_left() const;
  // Where it did not get to, as openings.hpp; none before the first tick. done: rooms to leave out. Ticked after its
  // end it explores on from where the robot is then.
  [[nodiscard]] std::optional<Point> room_out_of_reach(const WorldView& world, const std::vector<Point>& done) const;

 private:
  ExploreConfig config_;
  std::unique_ptr<Exploration> run_;  // from the first tick on
  double begun_s_ = 0.0;
  std::optional<ExploreProgress> progress_;
};

}  // namespace cairn::behaviours
