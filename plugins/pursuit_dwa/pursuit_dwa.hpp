// The default controller: pure pursuit of the path, and the dynamic window approach where obstacles are near.
#pragma once

#include "framework/contracts/controller.hpp"
#include "plugins/pursuit_dwa/dynamic_window.hpp"
#include "plugins/pursuit_dwa/path_follower.hpp"

namespace cairn::pursuit_dwa {

struct PursuitDwaConfig {
  FollowSettings follow;
  WindowSettings avoid;
  static void describe(Fields<PursuitDwaConfig>& fields);
};

class PursuitDwa : public Controller {
 public:
  explicit PursuitDwa(const PursuitDwaConfig& config) : config_(config) {}
  // Keeps nothing between two calls: all that it needs of the last one is in the request.
  ControlResult control(const ControlRequest& request, const WorldView& world) override;

 private:
  PursuitDwaConfig config_;
};

}  // namespace cairn::pursuit_dwa
