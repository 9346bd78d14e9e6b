// How much is remembered of a long mission, in its map and in its report. Shorter ones are remembered whole.
#pragma once

#include <cstddef>

#include "framework/config/fields.hpp"
#include "framework/landmarks/driven_path.hpp"

namespace cairn {

struct HistoryConfig {
  std::size_t max_path_poses = DrivenPath::kMaxPoses;
  std::size_t max_samples = 10000;
  std::size_t max_events = 10000;
  static void describe(Fields<HistoryConfig>& fields);
};

}  // namespace cairn
