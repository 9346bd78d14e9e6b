#include "framework/mission/loop_closing.hpp"

#include <fmt/format.h>

#include "framework/modules/fence.hpp"
#include "framework/modules/plausibility.hpp"

namespace cairn {
namespace {

class CountedCall {
 public:
  explicit CountedCall(CallsUnderWay& calls) : calls_(calls) { ++calls_; }
  ~CountedCall() { --calls_; }
  CountedCall(const CountedCall&) = delete;
  CountedCall& operator=(const CountedCall&) = delete;

 private:
  CallsUnderWay& calls_;
};

std::string fault_of_all(const std::vector<LoopProposal>& proposals, std::size_t submaps) {
  if (proposals.size() > submaps)
    return fmt::format("proposed {} loops where it was asked for {} submaps", proposals.size(), submaps);
  std::vector<bool> is_proposed(submaps);
  for (const LoopProposal& proposal : proposals) {
    if (std::string fault = fault_of(proposal, submaps); !fault.empty()) return fault;
    if (is_proposed[proposal.submap])
      return fmt::format("proposed two loops with submap {} of {}", proposal.submap + 1, submaps);
    is_proposed[proposal.submap] = true;
  }
  return {};
}

}  // namespace

std::vector<LoopProposal> FencedLoopCloser::propose(const LoopQuery& query, const Budget& budget) {
  const CountedCall call(*calls_);
  std::vector<LoopProposal> proposals =
      fenced(kLoopCloserStage, module_, [&] { return closer_->propose(query, budget); });
  if (const std::string fault = fault_of_all(proposals, query.submaps.size()); !fault.empty())
    throw ModuleFault(kLoopCloserStage, module_, fault);
  return proposals;
}

}  // namespace cairn
