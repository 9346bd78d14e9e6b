#include "plugins/submap_correlation/submap_correlation.hpp"

#include <algorithm>
#include <cmath>

#include "maps/pose_graph/information.hpp"

namespace cairn::submap_correlation {
namespace {

constexpr double kFieldCell_m = 0.1;
constexpr int kLevels = 6;
constexpr std::size_t kPyramidsKept = 24;
constexpr double kReach_m = 6.0;  // of a submap around its nodes
constexpr std::size_t kMaxSubmaps = 4;
constexpr double kFloor_m = 0.03;
constexpr double kFloor_rad = radians(0.4);

// The nearest first, up to that far; of some as near, the earlier ones first.
std::vector<std::size_t> nearest(std::span<const PassedSubmap> submaps, double reach_m) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < submaps.size(); ++i)
    if (submaps[i].distance_m <= reach_m) found.push_back(i);
  std::ranges::stable_sort(found, {}, [&](std::size_t i) { return submaps[i].distance_m; });
  return found;
}

}  // namespace

SubmapCorrelation::Window SubmapCorrelation::window_of(const LoopQuery& query) const {
  const double half_side_m = query.is_afterwards ? 0.5 * config_.min_window_m
                                                 : std::min(config_.min_window_m + query.drift_m, config_.max_window_m);
  return {half_side_m, query.max_turn_rad.value_or(config_.window_rad)};
}

const FieldPyramid& SubmapCorrelation::pyramid_of(const std::shared_ptr<const Submap>& submap) {
  const auto at =
      std::find_if(pyramids_.begin(), pyramids_.end(), [&](const auto& kept) { return kept.first == submap; });
  if (at != pyramids_.end()) {
    std::rotate(pyramids_.begin(), at, at + 1);
  } else {
    if (pyramids_.size() >= kPyramidsKept) pyramids_.pop_back();
    pyramids_.emplace(pyramids_.begin(), submap,
                      std::make_unique<FieldPyramid>(submap->pyramid(kFieldCell_m, config_.field_sigma_m, kLevels)));
  }
  return *pyramids_.front().second;
}

std::optional<LoopProposal> SubmapCorrelation::match(const LoopQuery& query, std::size_t submap, const Window& window) {
  const PassedSubmap& passed = query.submaps[submap];
  const Pose2 T_submap_guess = inverse(passed.T_map_submap) * query.T_map_node;
  const auto coarse = search(pyramid_of(passed.submap), query.points_m,
                             {T_submap_guess, window.half_side_m, window.half_angle_rad}, config_.min_score);
  if (!coarse) return std::nullopt;
  AlignmentSettings settings;
  settings.echo_sigma_m = query.echo_sigma_m;
  settings.first_sigma_m = 0.1;
  const Alignment aligned = align(passed.submap->surfaces(), query.points_m, coarse->T_field_scan, {}, settings);
  if (aligned.matched_ratio < config_.min_matched_ratio) return std::nullopt;
  const Pose2 moved = inverse(coarse->T_field_scan) * aligned.T_map_scan;
  if (moved.position().norm() > 0.3 || std::abs(moved.theta_rad) > radians(3.0)) return std::nullopt;
  const Eigen::Matrix3d information = with_floor(aligned.information, kFloor_m, kFloor_rad);
  return LoopProposal{submap, aligned.T_map_scan, information_in_turned(information, aligned.T_map_scan.theta_rad),
                      coarse->score};
}

std::vector<LoopProposal> SubmapCorrelation::propose(const LoopQuery& query, const Budget& budget) {
  std::vector<LoopProposal> proposals;
  const Window window = window_of(query);
  std::vector<std::size_t> candidates = nearest(query.submaps, kReach_m + window.half_side_m);
  candidates.resize(std::min(candidates.size(), query.is_afterwards ? 2 * kMaxSubmaps : kMaxSubmaps));
  for (const std::size_t submap : candidates) {
    if (budget.exhausted()) break;
    if (const auto proposal = match(query, submap, window)) proposals.push_back(*proposal);
  }
  return proposals;
}

}  // namespace cairn::submap_correlation
