#include "framework/contracts/module.hpp"

#include "plugins/behaviours/explore.hpp"
#include "plugins/behaviours/go_to.hpp"
#include "plugins/behaviours/simple_steps.hpp"

namespace {

using namespace cairn;
using namespace cairn::behaviours;

void register_module(Registrar& registrar) {
  registrar.add<Behaviour, ExploreConfig>(
      "explore", "explores the reachable space at a safe distance and looks closer at what it finds",
      [](const ExploreConfig& config, const ModuleContext&) { return std::make_unique<Explore>(config); });
  registrar.add<Behaviour, GoToConfig>("goto", "goes to a landmark or a place by the mission's planner",
                                       [](const GoToConfig& config, const ModuleContext& context) {
                                         return std::make_unique<GoTo>(config, context.seed);
                                       });
  registrar.add<Behaviour, DriveConfig>("drive", "drives straight from point to point",
                                        [](const DriveConfig& config, const ModuleContext& context) {
                                          return std::make_unique<DriveTo>(config, context.seed);
                                        });
  registrar.add<Behaviour, WaitConfig>(
      "wait", "stands still for a time",
      [](const WaitConfig& config, const ModuleContext&) { return std::make_unique<Wait>(config); });
  registrar.add<Behaviour, SaveConfig>(
      "save", "saves the map so far into the output folder",
      [](const SaveConfig& config, const ModuleContext&) { return std::make_unique<Save>(config); });
}

}  // namespace

CAIRN_MODULE(register_module)
