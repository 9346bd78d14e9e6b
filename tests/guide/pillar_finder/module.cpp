#include "framework/contracts/module.hpp"

#include "pillar_finder.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using pillar_finder::Config;
  using pillar_finder::PillarFinder;
  registrar.add<cairn::Detector, Config>(
      "pillar_finder", "finds round pillars of one diameter",
      [](const Config& config, const cairn::DetectorContext&) { return std::make_unique<PillarFinder>(config); });
}

}  // namespace

CAIRN_MODULE(register_module)
