// Mapper (plugin kind `map`): from posed observations to OG1.
#pragma once

#include "framework/contracts/localizer.hpp"
#include "framework/contracts/module_context.hpp"
#include "framework/contracts/observation.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

class Mapper {
 public:
  virtual ~Mapper() = default;
  // Adds one observation and returns which cells may have changed; the answer is valid until the next
  // call. Readings that are NaN, negative or out of their sensor's range follow stated rules; none
  // throws. Hot: no allocation once the grid covers what is seen.
  virtual const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) = 0;
  // One and the same object as long as the mapper lives.
  [[nodiscard]] virtual const OccupancyGrid& grid() const = 0;
};

struct MapperContext : ModuleContext {
  // What an earlier run of the mission has mapped, with the cells, origin and clamp that the settings give. The new map
  // begins with it. Null: with nothing.
  const OccupancyGrid* grid_so_far = nullptr;
};

template <>
struct PluginTraits<Mapper> {
  static constexpr PluginKind kKind = PluginKind::map;
  using Context = MapperContext;
};

}  // namespace cairn
