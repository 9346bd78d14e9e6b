#include "framework/contracts/module.hpp"

#include "plugins/murphy_map/murphy_map.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::murphy_map::Config;
  using cairn::murphy_map::MurphyMap;
  registrar.add<cairn::Mapper, Config>(
      "murphy", "occupancy grid from sonar, for comparison: the model of Murphy's textbook",
      [](const Config& config, const cairn::ModuleContext&) { return std::make_unique<MurphyMap>(config); });
}

}  // namespace

CAIRN_MODULE(register_module)
