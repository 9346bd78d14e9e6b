#include "framework/contracts/module.hpp"

#include "plugins/scan_to_map/scan_to_map.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::scan_to_map::Config;
  using cairn::scan_to_map::ScanToMap;
  registrar.add<cairn::Localizer, Config>(
      "scan_to_map", "odometry, corrected by laying each laser scan on those before it",
      [](const Config& config, const cairn::LocalizerContext& context) {
        return std::make_unique<ScanToMap>(config, context.robot, context.T_map_start);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
