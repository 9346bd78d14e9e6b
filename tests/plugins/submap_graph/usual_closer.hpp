// The loop closer that missions have when they name none.
#pragma once

#include <memory>

#include "plugins/submap_correlation/submap_correlation.hpp"

namespace cairn {

inline std::shared_ptr<LoopCloser> usual_closer() {
  return std::make_shared<submap_correlation::SubmapCorrelation>(submap_correlation::Config{});
}

}  // namespace cairn
