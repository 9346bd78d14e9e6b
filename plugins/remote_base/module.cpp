#include "framework/contracts/module.hpp"

#include "plugins/remote_base/remote_base.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace remote_base = cairn::remote_base;
  registrar.add<cairn::Sensor, remote_base::Config>(
      "remote_base", "drives a base of its own, another process, over a socket",
      [](const remote_base::Config& config, const cairn::SensorContext& context) {
        return std::make_unique<remote_base::RemoteBase>(config, context.robot);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
