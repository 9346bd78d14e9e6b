#include "framework/contracts/module.hpp"

#include "plugins/carmen_log/carmen_log.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace carmen_log = cairn::carmen_log;
  registrar.add<cairn::Sensor, carmen_log::Config>(
      "carmen_log", "plays back a CARMEN log: laser and sonar lines with their poses",
      [](const carmen_log::Config& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::log_common::ScanPlayer>(carmen_log::read_carmen_log(config, context.budget));
      });
}

}  // namespace

CAIRN_MODULE(register_module)
