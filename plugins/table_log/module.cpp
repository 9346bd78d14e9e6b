#include "framework/contracts/module.hpp"

#include "plugins/table_log/table_log.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  registrar.add<cairn::Sensor, cairn::TableLogConfig>(
      "table_log", "plays back a recorded table of range readings and poses",
      [](const cairn::TableLogConfig& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::TableLog>(config, context.robot, context.budget);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
