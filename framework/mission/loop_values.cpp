// What behaviours ask the host for beside plans and saved maps: the mission's controller, and values by name.

#include <cmath>

#include "framework/mission/loop.hpp"

namespace cairn {
namespace {

bool is_finite(const Twist& twist) {
  return std::isfinite(twist.v_mps) && std::isfinite(twist.w_radps);
}

}  // namespace

ControlResult MissionLoop::control(const ControlRequest& request) {
  const StageClock::Visit visit(clock_, StageClock::kHost);
  if (!modules_.controller)
    throw std::runtime_error("wants to follow a path, but there is no controller: no module " +
                             mission_.config.controller.name + " was found");
  ControlRequest asked = request;
  asked.is_new_path = request.is_new_path || controlled_ != ticked_;
  controlled_ = ticked_;
  const WorldView world = view();
  const ControlResult result = in_stage(controller_, [&] { return modules_.controller->control(asked, world); });
  if (!is_finite(result.twist) || !is_finite(result.unhindered) || !std::isfinite(result.progress.along_m))
    throw ModuleFault("controller", clock_.module_of(controller_), "returned a velocity that is not finite");
  return result;
}

std::optional<Place> MissionLoop::input(const std::string& name) {
  const StageClock::Visit visit(clock_, StageClock::kHost);
  const auto found = values_.find(name);
  return found == values_.end() ? std::nullopt : std::optional(found->second);
}

void MissionLoop::output(const std::string& name, const Place& place) {
  const StageClock::Visit visit(clock_, StageClock::kHost);
  if (!values_.contains(name) && values_.size() >= kMaxNamedValues)
    throw std::runtime_error("gives more than " + std::to_string(kMaxNamedValues) + " named values");
  values_[name] = place;
}

}  // namespace cairn
