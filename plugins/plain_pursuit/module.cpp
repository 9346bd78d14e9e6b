#include "framework/contracts/module.hpp"

#include "plugins/plain_pursuit/plain_pursuit.hpp"

namespace {

using namespace cairn;
using namespace cairn::plain_pursuit;

void register_module(Registrar& registrar) {
  registrar.add<Controller, PlainPursuitConfig>(
      "plain_pursuit", "follows the path by pure pursuit and stops before what is in its path",
      [](const PlainPursuitConfig& config, const ModuleContext&) { return std::make_unique<PlainPursuit>(config); });
}

}  // namespace

CAIRN_MODULE(register_module)
