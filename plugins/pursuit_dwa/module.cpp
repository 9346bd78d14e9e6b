#include "framework/contracts/module.hpp"

#include "plugins/pursuit_dwa/pursuit_dwa.hpp"

namespace {

using namespace cairn;
using namespace cairn::pursuit_dwa;

void register_module(Registrar& registrar) {
  registrar.add<Controller, PursuitDwaConfig>(
      "pursuit_dwa", "follows the path by pure pursuit and avoids obstacles by the dynamic window approach",
      [](const PursuitDwaConfig& config, const ModuleContext&) { return std::make_unique<PursuitDwa>(config); });
}

}  // namespace

CAIRN_MODULE(register_module)
