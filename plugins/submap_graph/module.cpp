#include "framework/contracts/module.hpp"

#include <memory>

#include "plugins/submap_graph/submap_graph.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::submap_graph::Config;
  using cairn::submap_graph::SubmapGraph;
  registrar.add<cairn::Localizer, Config>(
      "submap_graph", "odometry and laser scans: submaps in a pose graph that closes loops and corrects the past",
      [](const Config& config, const cairn::LocalizerContext& context) {
        return std::make_unique<SubmapGraph>(config, context.T_map_start,
                                             context.loop_closer ? context.loop_closer() : nullptr, context.robot,
                                             context.saved_submaps, context.start_uncertainty);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
