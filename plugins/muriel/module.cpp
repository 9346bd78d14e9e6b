#include "framework/contracts/module.hpp"

#include "plugins/muriel/muriel.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::muriel::Config;
  using cairn::muriel::Muriel;
  registrar.add<cairn::Mapper, Config>(
      "muriel", "occupancy grid from sonar and laser: Bayes with specular weighting and an independence log (MURIEL)",
      [](const Config& config, const cairn::ModuleContext&) { return std::make_unique<Muriel>(config); });
}

}  // namespace

CAIRN_MODULE(register_module)
