#include "plugins/baselines/bayes_map/bayes_map.hpp"
#include "plugins/common/sonar_model/add_map.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using namespace cairn::bayes_map;
  cairn::sonar_model::add_map<BayesMap, Config>(
      registrar, "bayes", "occupancy grid from sonar: recursive Bayes in log-odds, each reading on its own");
}

}  // namespace

CAIRN_MODULE(register_module)
