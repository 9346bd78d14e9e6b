#include "framework/contracts/module.hpp"

#include "plugins/picture_log/picture_log.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace picture_log = cairn::picture_log;
  registrar.add<cairn::Sensor, picture_log::Config>(
      "picture_log", "plays back another log with the pictures that cameras took beside it",
      [](const picture_log::Config& config, const cairn::SensorContext& context) {
        if (context.modules == nullptr) throw std::invalid_argument("picture_log: no maker of modules in its context");
        return picture_log::with_pictures(context.modules->make<cairn::Sensor>(config.log, context), config, context);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
