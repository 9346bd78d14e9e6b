#include "framework/contracts/module.hpp"

#include "planners/landmark_search/flat_search.hpp"
#include "planners/landmark_search/landmark_search.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  registrar.add<cairn::RoutePlanner, cairn::LandmarkSearchConfig>(
      "landmark_search",
      "shortest path from landmark to landmark over the stored routes, exact and fast on graphs of any size",
      [](const cairn::LandmarkSearchConfig& config, const cairn::ModuleContext&) {
        return std::make_unique<cairn::LandmarkSearch>(config);
      });
  registrar.add<cairn::RoutePlanner, cairn::NoConfig>(
      "flat_search", "the shortest path over the stored routes by Dijkstra's algorithm, to compare with",
      [](const cairn::NoConfig&, const cairn::ModuleContext&) { return std::make_unique<cairn::FlatSearch>(); });
}

}  // namespace

CAIRN_MODULE(register_module)
