#include "framework/contracts/module.hpp"

#include "plugins/json_log/json_log.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace json_log = cairn::json_log;
  registrar.add<cairn::Sensor, json_log::Config>(
      "json_log", "plays back laser scans with poses from a JSON file",
      [](const json_log::Config& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::log_common::ScanPlayer>(json_log::read_json_log(config, context.budget));
      });
}

}  // namespace

CAIRN_MODULE(register_module)
