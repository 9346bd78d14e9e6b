#include "planners/ompl/search/algorithm_parameters.hpp"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/util/Console.h>

#include "planners/ompl/search/algorithm_factory.hpp"

namespace cairn {
namespace {

namespace ob = ompl::base;

bool takes(ob::Planner& planner, const std::string& name, const std::string& value) {
  try {
    return planner.params().setParam(name, value);
  } catch (const std::exception&) {  // a number that is none, or one the algorithm refuses
    return false;
  }
}

}  // namespace

AlgorithmParameters checked_parameters(Algorithm algorithm, const ConfigValue& parameters) {
  ompl::msg::noOutputHandler();  // here, where every planner of ours begins
  if (parameters.kind == ConfigValue::Kind::null) return {};
  if (parameters.kind != ConfigValue::Kind::map)
    throw ConfigError(parameters.place,
                      "parameters must be a map of OMPL's parameter names, not " + parameters.kind_name());
  auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  space->setBounds(0.0, 1.0);
  const ob::PlannerPtr planner = make_algorithm(algorithm, std::make_shared<ob::SpaceInformation>(space));
  std::vector<std::string> names;
  planner->params().getParamNames(names);
  AlgorithmParameters checked;
  for (const ConfigValue::Entry& entry : parameters.entries) {
    if (!planner->params().hasParam(entry.key))
      throw ConfigError(entry.key_place, planner->getName() + " has no parameter \"" + entry.key + "\"" +
                                             did_you_mean(entry.key, names));
    if (entry.value.kind != ConfigValue::Kind::scalar || !takes(*planner, entry.key, entry.value.scalar))
      throw ConfigError(entry.value.place, "parameter " + entry.key + " of " + planner->getName() +
                                               " does not take \"" + entry.value.scalar + "\"");
    checked.emplace_back(entry.key, entry.value.scalar);
  }
  return checked;
}

}  // namespace cairn
