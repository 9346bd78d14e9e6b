// The part of the graph that earlier runs have left in the saved map. It is held: what this run drives bends onto it,
// it bends no more, since no readings are left to draw its map from again.
#pragma once

#include <memory>
#include <vector>

#include "framework/contracts/localizer.hpp"
#include "maps/submaps/submap.hpp"
#include "plugins/submap_graph/config.hpp"
#include "plugins/submap_graph/local_map.hpp"

namespace cairn::submap_graph {

using FinishedSubmaps = std::vector<std::shared_ptr<const Submap>>;

struct EarlierPart {
  std::vector<Pose2> T_map_node;
  FinishedSubmaps submaps;  // of these nodes
  StartUncertainty start{};
};

// start: of this run. There must be no fault (fault_of()).
[[nodiscard]] EarlierPart earlier_part_of(const KeptSubmaps& saved, const Config& config,
                                          const StartUncertainty& start);
// How far the start pose may be off, as the drift on the way counts it: three deviations. 0 without earlier nodes,
// where the start is the map's origin.
[[nodiscard]] double start_drift_m(const EarlierPart& earlier);
// What is known of a run's first node without a closure: where the start pose is said to be, from the nearest node.
[[nodiscard]] LocalMap::Tie start_tie(const EarlierPart& earlier, const Pose2& T_map_start);

}  // namespace cairn::submap_graph
