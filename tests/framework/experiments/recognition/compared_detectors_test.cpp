// The experiment of curves with the shipped detectors: all of them look for the mission's own templates.
#include <gtest/gtest.h>

#include <filesystem>

#include "framework/experiments/recognition/curves.hpp"
#include "framework/mission/modules.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;

TEST(ComparedDetectors, HaveTheMissionsTemplates) {
  const ModuleLibrary library({fs::path(CAIRN_BINARY_DIR) / "lib" / "cairn"});
  const ExperimentConfig experiment =
      load_experiment(fs::path(CAIRN_SOURCE_DIR) / "config" / "experiments" / "baselines.yaml");
  const Mission mission = load_mission(experiment.missions.front(),
                                       {"detector.rendering=ideal", "detector.step_deg=45", "detector.sizes=[1, 1.2]"});
  const TemplateSettings own = mission.template_settings;
  ASSERT_EQ(own.sizes.size(), 2U);
  ASSERT_EQ(experiment.detectors.size(), 4U);
  for (const ComparedDetector& detector : experiment.detectors) {
    const Mission compared = with_detector(mission, detector, library);
    const TemplateSettings& settings = compared.template_settings;
    EXPECT_EQ(settings.sizes, own.sizes) << detector.name;
    EXPECT_EQ(settings.templates, own.templates) << detector.name;
    EXPECT_EQ(settings.step_rad, own.step_rad) << detector.name;
    EXPECT_EQ(settings.rendering, own.rendering) << detector.name;
    EXPECT_EQ(settings.ring_offset_m, own.ring_offset_m) << detector.name;
    // The module takes them, too.
    EXPECT_NE(build_detector(compared, library, 0.05), nullptr) << detector.name;
  }
}

}  // namespace
}  // namespace cairn
