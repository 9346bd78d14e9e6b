#include "framework/contracts/module.hpp"

#include <memory>
#include <stdexcept>

#include "plugins/submap_correlation/submap_correlation.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::submap_correlation::Config;
  using cairn::submap_correlation::SubmapCorrelation;
  registrar.add<cairn::LoopCloser, Config>(
      "submap_correlation", "searches a laser's scan or gathered echoes of sonars in the submaps near by",
      [](const Config& config, const cairn::ModuleContext&) {
        if (config.min_window_m > config.max_window_m)
          throw std::invalid_argument("submap_correlation: min_window_m must not be above max_window_m");
        return std::make_unique<SubmapCorrelation>(config);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
