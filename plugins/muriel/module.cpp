#include "framework/contracts/module.hpp"

#include "plugins/muriel/muriel.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::muriel::Config;
  using cairn::muriel::Muriel;
  registrar.add<cairn::Mapper, Config>(
      "muriel", "occupancy grid from sonar and laser: Bayes with specular weighting and an independence log (MURIEL)",
      [](const Config& config, const cairn::MapperContext& context) {
        auto map = std::make_unique<Muriel>(config);
        map->clear_under(context.robot);
        if (context.grid_so_far != nullptr) map->begin_with(*context.grid_so_far);
        return map;
      });
}

}  // namespace

CAIRN_MODULE(register_module)
