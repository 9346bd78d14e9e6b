// The modules in Python of docs/examples pass the suites of their kinds.
#include "tests/conformance/behaviour.hpp"
#include "tests/conformance/detector.hpp"
#include "tests/conformance/sensor.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

std::string config_of(const std::string& file, const std::string& name, const std::string& settings) {
  return std::string("{file: \"") + CAIRN_SOURCE_DIR + "/docs/examples/python_modules/" + file + "\", class: " + name +
         ", settings: " + settings + "}";
}

// What it knows of the shapes that the suite draws.
TemplateSet circle_only() {
  TemplateSet set = three_templates();
  std::erase_if(set.shapes, [](const LandmarkShape& shape) { return shape.category != "circle"; });
  return set;
}

INSTANTIATE_TEST_SUITE_P(Python, DetectorConformance,
                         testing::Values(module<Detector>(kModules, "python",
                                                          config_of("round_pillars.py", "RoundPillars",
                                                                    "{diameter_m: 0.5}"))
                                             .with_templates(circle_only())));

INSTANTIATE_TEST_SUITE_P(
    Python, BehaviourConformance,
    testing::Values(module<Behaviour>(kModules, "python", config_of("drive_square.py", "DriveSquare", "{side_m: 0.8}")),
                    module<Behaviour>(kModules, "python", config_of("visit_landmarks.py", "VisitLandmarks", "{}"))));

INSTANTIATE_TEST_SUITE_P(
    Python, SensorConformance,
    testing::Values(module<Sensor>(kModules, "python",
                                   config_of("csv_replay.py", "CsvReplay",
                                             std::string("{file: \"") + CAIRN_SOURCE_DIR +
                                                 "/docs/examples/python_modules/corridor.csv\"}"))));

}  // namespace
}  // namespace cairn::conformance
