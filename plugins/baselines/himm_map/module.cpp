#include "framework/contracts/module.hpp"

#include "plugins/baselines/himm_map/himm_map.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::himm_map::Config;
  using cairn::himm_map::HimmMap;
  registrar.add<cairn::Mapper, Config>(
      "himm", "occupancy grid from sonar, for comparison: histogrammic in-motion mapping (HIMM)",
      [](const Config& config, const cairn::MapperContext& context) {
        auto map = std::make_unique<HimmMap>(config);
        map->clear_under(context.robot);
        if (context.grid_so_far != nullptr) map->begin_with(*context.grid_so_far);
        return map;
      });
}

}  // namespace

CAIRN_MODULE(register_module)
