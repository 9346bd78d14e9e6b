// Loop closer: a node's echoes are searched in the submaps near by, of lasers and of sonars alike, by branch and bound
// over a window of poses, and then laid on the submap's walls (docs/slam.md).
//
//   no echoes                    no proposal
//   submaps beyond the window    left out; of the others the nearest four, at the end eight
//   several poses that fit       the best one; whether it is true, others must say
//
// The fields of the submaps searched last are kept: about 24 of them.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "framework/contracts/loop_closer.hpp"
#include "plugins/submap_correlation/config.hpp"

namespace cairn::submap_correlation {

class SubmapCorrelation final : public LoopCloser {
 public:
  explicit SubmapCorrelation(const Config& config) : config_(config) {}

  [[nodiscard]] std::vector<LoopProposal> propose(const LoopQuery& query, const Budget& budget) override;

 private:
  struct Window {
    double half_side_m = 0.0;
    double half_angle_rad = 0.0;
  };
  [[nodiscard]] Window window_of(const LoopQuery& query) const;
  [[nodiscard]] std::optional<LoopProposal> match(const LoopQuery& query, std::size_t submap, const Window& window);
  [[nodiscard]] const FieldPyramid& pyramid_of(const std::shared_ptr<const Submap>& submap);

  Config config_;
  std::vector<std::pair<std::shared_ptr<const Submap>, std::unique_ptr<FieldPyramid>>> pyramids_;  // latest used first
};

}  // namespace cairn::submap_correlation
