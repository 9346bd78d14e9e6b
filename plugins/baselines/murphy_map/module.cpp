#include "plugins/baselines/murphy_map/murphy_map.hpp"
#include "plugins/common/sonar_model/add_map.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using namespace cairn::murphy_map;
  cairn::sonar_model::add_map<MurphyMap, Config>(
      registrar, "murphy", "occupancy grid from sonar, for comparison: the model of Murphy's textbook");
}

}  // namespace

CAIRN_MODULE(register_module)
