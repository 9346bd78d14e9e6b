// A module that is called in its stage: timed, watched and fenced.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "framework/modules/fence.hpp"
#include "framework/modules/stage_clock.hpp"

namespace cairn {

// Calls in a stage. Throws ModuleFault for whatever the call throws; GivenUp when the mission was given up meanwhile,
// however the call comes back.
template <class Call>
auto in_stage(StageClock& clock, StageClock::Id stage, Call&& call) -> decltype(call()) {
  const auto visit_and_call = [&]() -> decltype(call()) {
    const StageClock::Visit visit(clock, stage);
    return fenced(clock.stage_of(stage), clock.module_of(stage), std::forward<Call>(call));
  };
  try {
    if constexpr (std::is_void_v<decltype(call())>) {
      visit_and_call();
      clock.check();
    } else {
      decltype(auto) result = visit_and_call();
      clock.check();
      return result;
    }
  } catch (const ModuleFault&) {
    clock.check();
    throw;
  }
}

template <class Module>
class Staged {
 public:
  Staged() = default;
  // The clock must outlive it.
  Staged(std::shared_ptr<Module> module, StageClock& clock, StageClock::Id stage)
      : module_(std::move(module)), clock_(&clock), stage_(stage) {}

  explicit operator bool() const { return module_ != nullptr; }
  [[nodiscard]] StageClock::Id stage() const { return stage_; }

  // call: takes the module. What it returns is returned.
  template <class Call>
  auto call(Call&& call) const -> decltype(call(std::declval<Module&>())) {
    return in_stage(*clock_, stage_, [&]() -> decltype(call(std::declval<Module&>())) { return call(*module_); });
  }
  // Something of the module (the drive of a sensor) that keeps it alive.
  template <class Part>
  [[nodiscard]] std::shared_ptr<Part> part(Part* part) const {
    return part == nullptr ? nullptr : std::shared_ptr<Part>(module_, part);
  }
  // To be thrown when what it returned cannot be.
  [[nodiscard]] ModuleFault fault(const std::string& what) const {
    return {clock_->stage_of(stage_), clock_->module_of(stage_), what};
  }
  // Another one of the same name from now on.
  void replace(std::shared_ptr<Module> module) { module_ = std::move(module); }
  // Outside of the stage, neither watched nor fenced: for the thread that has given the mission up.
  [[nodiscard]] Module& unwatched() const { return *module_; }

 private:
  std::shared_ptr<Module> module_;
  StageClock* clock_ = nullptr;
  StageClock::Id stage_ = StageClock::kHost;
};

}  // namespace cairn
