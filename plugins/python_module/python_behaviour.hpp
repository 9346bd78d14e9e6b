// A step of a mission written in Python. Plugin `python`, kind behaviour.
#pragma once

#include "framework/contracts/behaviour.hpp"
#include "plugins/python_module/python_object.hpp"
#include "plugins/python_module/requests.hpp"

namespace cairn::python_module {

class PythonBehaviour : public Behaviour {
 public:
  PythonBehaviour(const BehaviourConfig& config, const BehaviourFactoryContext& context);
  // Calls tick(world, ask) of the class.
  Status tick(const WorldView& world, BehaviourContext& context) override;
  // Calls halt() of the class; one without is made anew by the next tick.
  void halt() override;
  [[nodiscard]] bool needs_pose() const override { return needs_pose_; }

 private:
  PythonObject object_;
  const std::uint64_t seed_;
  bool needs_pose_ = true;
  bool has_halt_ = false;
  bool is_stale_ = false;
  FollowedPath path_;
};

}  // namespace cairn::python_module
