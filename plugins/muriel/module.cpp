#include "plugins/common/sonar_model/add_map.hpp"
#include "plugins/muriel/muriel.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using namespace cairn::muriel;
  cairn::sonar_model::add_map<Muriel, Config>(
      registrar, "muriel",
      "occupancy grid from sonar and laser: Bayes with specular weighting and an independence log (MURIEL)");
}

}  // namespace

CAIRN_MODULE(register_module)
