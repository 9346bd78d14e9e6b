#include "framework/contracts/module.hpp"

#include "plugins/lego_log/lego_log.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace lego_log = cairn::lego_log;
  registrar.add<cairn::Sensor, lego_log::Config>(
      "lego_log", "plays back laser scans and wheel counts of a small two-wheeled robot",
      [](const lego_log::Config& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::log_common::ScanPlayer>(
            lego_log::read_lego_log(config, context.T_map_start.theta_rad, context.budget));
      });
}

}  // namespace

CAIRN_MODULE(register_module)
