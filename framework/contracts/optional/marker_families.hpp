// A marker detector that may also implement this: one that knows which families of markers it looks for, so that a
// mission that names a marker it can never see is refused before it begins.
#pragma once

#include <vector>

#include "maps/landmarks/marker_id.hpp"

namespace cairn {

class MarkerFamilies {
 public:
  virtual ~MarkerFamilies() = default;
  [[nodiscard]] virtual std::vector<MarkerFamily> families() const = 0;
};

}  // namespace cairn
