// Recoveries that move the robot a little where it is: backing up, and turning round to map afresh.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/world_view.hpp"

namespace cairn::behaviours {

struct BackUpSettings {
  double speed_mps = 0.04;  // few robots see well behind: what it touches it shall not push
  double distance_m = 0.2;
  double at_most_s = 6.0;
  static void describe(Fields<BackUpSettings>& fields);
};

class BackUp {
 public:
  // Whether a path behind the robot is blocked from along_m on, for ahead_m.
  using IsBlocked = std::function<bool(const std::vector<Point>& path, double along_m, double ahead_m)>;

  explicit BackUp(const BackUpSettings& settings = {}) : settings_(settings) {}

  // times: as far, and as long.
  void begin(const WorldView& world, int times = 1);
  // The velocity of this tick; none when it is over: far enough, for long enough, or something is behind.
  [[nodiscard]] std::optional<Twist> tick(const WorldView& world, const IsBlocked& is_blocked) const;

 private:
  BackUpSettings settings_;
  Point from_{0.0, 0.0};
  double begun_s_ = 0.0;
  int times_ = 1;
};

struct TurnRoundSettings {
  double first_rad = radians(100.0);
  double later_rad = radians(360.0);
  double speed_radps = radians(45.0);
  double at_most_s = 12.0;
  static void describe(Fields<TurnRoundSettings>& fields);
};

class TurnRound {
 public:
  explicit TurnRound(const TurnRoundSettings& settings = {}) : settings_(settings) {}

  void begin(const WorldView& world, bool is_first);
  // The velocity of this tick; none when it is over. A car does not turn.
  [[nodiscard]] std::optional<Twist> tick(const WorldView& world);

 private:
  TurnRoundSettings settings_;
  double left_rad_ = 0.0;
  double last_theta_rad_ = 0.0;
  double begun_s_ = 0.0;
};

}  // namespace cairn::behaviours
