#include "framework/contracts/module.hpp"

#include "plugins/baselines/murphy_map/murphy_map.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::murphy_map::Config;
  using cairn::murphy_map::MurphyMap;
  registrar.add<cairn::Mapper, Config>("murphy",
                                       "occupancy grid from sonar, for comparison: the model of Murphy's textbook",
                                       [](const Config& config, const cairn::MapperContext& context) {
                                         auto map = std::make_unique<MurphyMap>(config);
                                         map->clear_under(context.robot);
                                         if (context.grid_so_far != nullptr) map->begin_with(*context.grid_so_far);
                                         return map;
                                       });
}

}  // namespace

CAIRN_MODULE(register_module)
