// A pose history that may also implement this: one that holds submaps and a pose graph, which the saved map keeps.
#pragma once

#include "maps/submaps/kept_submaps.hpp"

namespace cairn {

class PoseGraphReport {
 public:
  virtual ~PoseGraphReport() = default;
  // As known now; takes a while. The host keeps the latest of them only where there are too many (keep_latest()).
  [[nodiscard]] virtual KeptSubmaps submaps() const = 0;
};

}  // namespace cairn
