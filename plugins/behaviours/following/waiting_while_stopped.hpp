// A behaviour that drives, and waits while somebody else holds the wheels (Observation::stopped_by).
//
// It is not ticked meanwhile, and its clock stands: no patience and no limit of time runs out.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "framework/contracts/behaviour.hpp"

namespace cairn::behaviours {

class WaitingWhileStopped : public Behaviour {
 public:
  explicit WaitingWhileStopped(std::unique_ptr<Behaviour> step) : step_(std::move(step)) {}

  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;
  [[nodiscard]] bool needs_pose() const override { return step_->needs_pose(); }

 private:
  std::unique_ptr<Behaviour> step_;
  std::optional<double> stopped_since_s_;
  double stopped_s_ = 0.0;  // in all, up to the last release
};

}  // namespace cairn::behaviours
