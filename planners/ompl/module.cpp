#include "framework/contracts/module.hpp"

#include "planners/ompl/ompl_planner.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  registrar.add<cairn::Planner, cairn::OmplConfig>(
      "ompl", "routes for a disc on the occupancy grid, by any of OMPL's sampling planners",
      [](const cairn::OmplConfig& config, const cairn::ModuleContext&) {
        return std::make_unique<cairn::OmplPlanner>(config);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
