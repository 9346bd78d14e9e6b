// The mission's loop closer as its localizer gets it: fenced and checked in whatever thread it is called, and known to
// be in a call while a localizer waits for it.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "framework/contracts/loop_closer.hpp"

namespace cairn {

// How many calls of a mission's loop closers are under way.
using CallsUnderWay = std::atomic<int>;

inline constexpr const char* kLoopCloserStage = "loop closer";

class FencedLoopCloser final : public LoopCloser {
 public:
  // module: its name.
  FencedLoopCloser(std::shared_ptr<LoopCloser> closer, std::string module, std::shared_ptr<CallsUnderWay> calls)
      : closer_(std::move(closer)), module_(std::move(module)), calls_(std::move(calls)) {}

  // Throws ModuleFault for what the module throws, and for proposals that cannot be.
  [[nodiscard]] std::vector<LoopProposal> propose(const LoopQuery& query, const Budget& budget) override;

 private:
  std::shared_ptr<LoopCloser> closer_;
  std::string module_;
  std::shared_ptr<CallsUnderWay> calls_;
};

}  // namespace cairn
