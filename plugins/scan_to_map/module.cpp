#include "framework/contracts/module.hpp"

#include <algorithm>

#include "plugins/scan_to_map/scan_to_map.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::scan_to_map::Config;
  using cairn::scan_to_map::ScanToMap;
  registrar.add<cairn::Localizer, Config>(
      "scan_to_map", "odometry, corrected by laying each laser scan on those before it",
      [](const Config& config, const cairn::LocalizerContext& context) {
        Config known = config;
        known.start_position_m = std::max(config.start_position_m, context.start_uncertainty.position_m);
        known.start_heading_rad = std::max(config.start_heading_rad, context.start_uncertainty.heading_rad);
        return std::make_unique<ScanToMap>(known, context.robot, context.T_map_start);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
