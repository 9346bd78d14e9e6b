#include "plugins/baselines/himm_map/himm_map.hpp"
#include "plugins/common/sonar_model/add_map.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using namespace cairn::himm_map;
  cairn::sonar_model::add_map<HimmMap, Config>(
      registrar, "himm", "occupancy grid from sonar, for comparison: histogrammic in-motion mapping (HIMM)");
}

}  // namespace

CAIRN_MODULE(register_module)
