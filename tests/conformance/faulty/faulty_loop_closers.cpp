// Loop closers that break their contract.
#include "tests/conformance/faulty/faulty_modules.hpp"
#include "tests/conformance/loop_closer.hpp"

namespace cairn::conformance {
namespace {

class WrappedCloser : public LoopCloser {
 public:
  explicit WrappedCloser(std::shared_ptr<LoopCloser> inner) : inner_(std::move(inner)) {}
  std::vector<LoopProposal> propose(const LoopQuery& query, const Budget& budget) override {
    return inner_->propose(query, budget);
  }

 protected:
  std::shared_ptr<LoopCloser> inner_;
};

class CredulousCloser : public WrappedCloser {
 public:
  using WrappedCloser::WrappedCloser;
  std::vector<LoopProposal> propose(const LoopQuery& query, const Budget& budget) override {
    std::vector<LoopProposal> proposals = WrappedCloser::propose(query, budget);
    for (LoopProposal& proposal : proposals)
      proposal.T_submap_node = inverse(query.submaps[proposal.submap].T_map_submap) * query.T_map_node;
    return proposals;
  }
};

class PatientCloser : public WrappedCloser {
 public:
  using WrappedCloser::WrappedCloser;
  std::vector<LoopProposal> propose(const LoopQuery& query, const Budget&) override {
    return WrappedCloser::propose(query, Budget{});
  }
};

class SingularCloser : public WrappedCloser {
 public:
  using WrappedCloser::WrappedCloser;
  std::vector<LoopProposal> propose(const LoopQuery& query, const Budget& budget) override {
    std::vector<LoopProposal> proposals = WrappedCloser::propose(query, budget);
    for (LoopProposal& proposal : proposals) proposal.information.row(2).setZero();
    return proposals;
  }
};

class RepeatingCloser : public WrappedCloser {
 public:
  using WrappedCloser::WrappedCloser;
  std::vector<LoopProposal> propose(const LoopQuery& query, const Budget& budget) override {
    std::vector<LoopProposal> proposals = WrappedCloser::propose(query, budget);
    if (query.submaps.size() > 1 && !proposals.empty()) proposals.push_back(proposals.front());
    return proposals;
  }
};

class SharedCloser : public WrappedCloser {
 public:
  using WrappedCloser::WrappedCloser;
  std::vector<LoopProposal> propose(const LoopQuery& query, const Budget& budget) override {
    static double calls = 0.0;
    std::vector<LoopProposal> proposals = WrappedCloser::propose(query, budget);
    for (LoopProposal& proposal : proposals) proposal.T_submap_node.x_m += 1e-6 * calls;
    calls += 1.0;
    return proposals;
  }
};

template <class Wrapper>
Subject<LoopCloser> closer(const std::string& name) {
  return wrapped<LoopCloser, Wrapper>(name, module<LoopCloser>(kModules, "submap_correlation"));
}
INSTANTIATE_TEST_SUITE_P(Faulty, LoopCloserConformance,
                         testing::Values(closer<CredulousCloser>("believes the guess"),
                                         closer<PatientCloser>("ignores its budget"),
                                         closer<SingularCloser>("information without a heading"),
                                         closer<RepeatingCloser>("proposes one twice"),
                                         closer<SharedCloser>("keeps its state in a static")));

}  // namespace
}  // namespace cairn::conformance
