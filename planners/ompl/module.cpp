#include "framework/contracts/module.hpp"

#include "planners/ompl/ompl_planner.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  registrar.add<cairn::PathPlanner, cairn::OmplConfig>(
      "ompl", "paths on the occupancy grid: the shortest, improved by OMPL, or by any of its sampling planners",
      [](const cairn::OmplConfig& config, const cairn::ModuleContext& context) {
        return std::make_unique<cairn::OmplPlanner>(config, context.robot);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
