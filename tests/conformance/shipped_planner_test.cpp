// Every shipped module of kind `planner` passes the suite of its kind; `ompl` with each of its algorithms, left to
// itself, and however the robot moves.
#include "planners/ompl/search/algorithms.hpp"
#include "tests/conformance/planner.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

Subject<Planner> with(const std::string& module, const std::string& name, const std::string& config_yaml) {
  return {name, ModuleSource({kModules}, module, config_yaml)};
}

std::vector<Subject<Planner>> algorithms() {
  std::vector<Subject<Planner>> all;
  for (const auto& [name, algorithm] : algorithm_names()) {
    // FMT* and BFMT* ask for each of their thousand samples before they begin.
    const std::string iterations = name.ends_with("FMT") ? "3000" : "1200";
    all.push_back(with(
        "ompl", name,
        "{algorithm: " + name + ", fall_back_to_grid: false, improve_iterations: 50, iterations: " + iterations + "}"));
  }
  return all;
}

std::vector<Subject<Planner>> kinematics() {
  std::vector<Subject<Planner>> all;
  for (const std::string kind : {"differential", "dubins", "reeds_shepp"}) {
    const std::string settings = "{kinematics: " + kind + ", turning_radius_m: 0.2, improve_iterations: 20}";
    all.push_back(with("ompl", kind, settings));
    all.push_back(with("hybrid", "hybrid over " + kind, "{route: {plugin: ompl, " + settings.substr(1) + "}"));
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Shipped, PlannerConformance,
                         testing::Values(module<Planner>(kModules, "landmark_search"),
                                         module<Planner>(kModules, "ompl"), module<Planner>(kModules, "hybrid")));
INSTANTIATE_TEST_SUITE_P(Algorithms, PlannerConformance, testing::ValuesIn(algorithms()));
INSTANTIATE_TEST_SUITE_P(Kinematics, PlannerConformance, testing::ValuesIn(kinematics()));

}  // namespace
}  // namespace cairn::conformance
