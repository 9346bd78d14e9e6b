#include "framework/contracts/module.hpp"

#include "planners/landmark_search/landmark_search.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  registrar.add<cairn::Planner, cairn::NoConfig>(
      "landmark_search", "shortest path from landmark to landmark over the stored routes (Dijkstra)",
      [](const cairn::NoConfig&, const cairn::ModuleContext&) { return std::make_unique<cairn::LandmarkSearch>(); });
}

}  // namespace

CAIRN_MODULE(register_module)
