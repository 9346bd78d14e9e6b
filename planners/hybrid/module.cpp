#include "framework/contracts/module.hpp"

#include <stdexcept>

#include "planners/hybrid/hybrid_planner.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  registrar.add<cairn::Planner, cairn::HybridConfig>(
      "hybrid", "landmarks first, then paths on the grid between them",
      [](const cairn::HybridConfig& config, const cairn::ModuleContext& context) {
        if (context.modules == nullptr) throw std::invalid_argument("hybrid: no maker of modules in its context");
        return std::make_unique<cairn::HybridPlanner>(
            config, context.modules->make<cairn::PathPlanner>(config.route, context),
            context.modules->make<cairn::RoutePlanner>(config.graph, context));
      });
}

}  // namespace

CAIRN_MODULE(register_module)
