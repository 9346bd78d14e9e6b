// How far a robot has come in a home, by the truth: which rooms it has entered, and how much of what it can reach is
// known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/world.hpp"
#include "framework/experiments/homes/home.hpp"
#include "framework/mission/events.hpp"
#include "framework/mission/runner.hpp"
#include "framework/reporting/report.hpp"

namespace cairn {

struct HomeVerdict {
  int rooms = 0;  // that a disc of the robot's radius gets to
  int entered = 0;
  double area_m2 = 0.0;  // that the robot's centre can get to
  double known_ratio = 0.0;
  std::optional<double> known_90_s;  // mission time at which 90 % of it was known
  int contacts = 0;
  int fast_contacts = 0;  // with what could be seen
  bool said_success = false;
  std::string end;               // what the first step that explored said at its end
  std::vector<int> not_entered;  // of the home's rooms, of those that can be entered
};

class HomeRecord : public Listener {
 public:
  // The home is that of the world. Time: a flood of the world at the robot's radius.
  HomeRecord(const HomesConfig& config, Home home, const World& world, double radius_m);

  // Notes ticks in which the truth is known; counts the map once a second.
  void on(const Event& event, const MissionView& view) override;

  [[nodiscard]] HomeVerdict verdict(const MissionResult& result, const std::vector<TimedContact>& contacts) const;

 private:
  void count(const OccupancyGrid& grid, double time_s);

  HomesConfig config_;
  Home home_;
  std::vector<Point> reachable_m_;  // places of the robot's centre
  double cell_m2_ = 0.0;
  std::vector<char> can_enter_;  // of the rooms
  std::vector<char> entered_;
  double counted_s_ = -1e9;
  double known_ratio_ = 0.0;
  std::optional<double> known_90_s_;
};

}  // namespace cairn
