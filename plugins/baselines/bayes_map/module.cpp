#include "framework/contracts/module.hpp"

#include "plugins/baselines/bayes_map/bayes_map.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::bayes_map::BayesMap;
  using cairn::bayes_map::Config;
  registrar.add<cairn::Mapper, Config>(
      "bayes", "occupancy grid from sonar: recursive Bayes in log-odds, each reading on its own",
      [](const Config& config, const cairn::MapperContext& context) {
        auto map = std::make_unique<BayesMap>(config);
        map->clear_under(context.robot);
        if (context.grid_so_far != nullptr) map->begin_with(*context.grid_so_far);
        return map;
      });
}

}  // namespace

CAIRN_MODULE(register_module)
