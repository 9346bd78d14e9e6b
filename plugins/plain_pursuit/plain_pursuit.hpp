// A plain controller, to read as an example: pure pursuit that stops before what is on its arc and waits until it
// has gone. It never goes round anything; the behaviour that drives plans another path.
#pragma once

#include "framework/config/fields.hpp"
#include "framework/contracts/controller.hpp"

namespace cairn::plain_pursuit {

struct PlainPursuitConfig {
  double lookahead_m = 0.3;
  double clearance_m = 0.05;
  double stop_ahead_m = 0.25;
  double turn_in_place_rad = radians(60.0);
  double max_turn_radps = radians(50.0);
  static void describe(Fields<PlainPursuitConfig>& fields);
};

class PlainPursuit : public Controller {
 public:
  explicit PlainPursuit(const PlainPursuitConfig& config) : config_(config) {}
  ControlResult control(const ControlRequest& request, const WorldView& world) override;

 private:
  PlainPursuitConfig config_;
};

}  // namespace cairn::plain_pursuit
