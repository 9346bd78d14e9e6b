// `cairn template capture`: the square of the office, cut out of the map of it, is found there again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/contracts/detector.hpp"
#include "framework/files/robot_file.hpp"
#include "framework/files/template_file.hpp"
#include "framework/modules/module_library.hpp"
#include "framework/templates/sensed_templates.hpp"
#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::HasSubstr;

PluginChoice choice(const std::string& name, const std::string& settings) {
  return {name, parse_config_text(settings, name)};
}

class OfficeCapture : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fresh_folder("office_capture");
    const Finished run =
        run_cairn({"run", source_folder() + "/config/missions/office.yaml", "--seed", "7", "--out", folder_.string()});
    ASSERT_EQ(run.exit_status, 0) << run.err;
  }
  static Finished capture(const std::string& at, const std::string& category, const std::string& file,
                          const std::string& radius = "0.8") {
    return run_cairn({"template", "capture", map().string(), "--at", at, "--category", category, "-o",
                      (folder_ / file).string(), "--radius-m", radius, "--json"});
  }
  static std::filesystem::path map() { return folder_ / "office.cairn"; }

  static std::filesystem::path folder_;
};
std::filesystem::path OfficeCapture::folder_;

// The best match of one shape in a map.
std::optional<Detection> found_in(const OccupancyGrid& grid, const LandmarkShape& shape) {
  const ModuleLibrary library({std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn"});
  const RobotModel robot = load_robot(source_folder() + "/config/robots/pioneer1.yaml");
  DetectorContext context{{robot}};
  context.templates = std::make_shared<TemplateSet>(render_sensed_set({shape}, radians(15.0), 0.05, {}, robot,
                                                                      choice("simulated_robot", "{}"),
                                                                      choice("muriel", "{cell_m: 0.05}"), library));
  const auto detector =
      library.make<Detector>(choice("template_matcher", "{coarse_cells: 5, tau_match: 0.5}"), context);
  std::optional<Detection> best;
  for (const Matching& matching : detector->detect(grid, everything_in(grid.bounds()), Budget()).matchings) {
    if (matching.detection && (!best || matching.detection->degree > best->degree)) best = matching.detection;
  }
  return best;
}

TEST_F(OfficeCapture, CutsTheSquareOutSoThatItIsFoundThereAgain) {
  const Finished finished = capture("nearest square", "crate", "crate.yaml");
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const LandmarkShape shape = load_landmark_shape(folder_ / "crate.yaml");
  EXPECT_EQ(shape.category, "crate");
  ASSERT_EQ(shape.contour.polygons_m.size(), 1U);
  EXPECT_NEAR(shape.contour.inner_diameter_m(), 0.5, 0.15) << text_of_file(folder_ / "crate.yaml");
  EXPECT_NEAR(shape.contour.outer_diameter_m(), 0.71, 0.15);
  const std::optional<Detection> found = found_in(load_map(map()).grid, shape);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->category, "crate");
  EXPECT_NEAR((found->T_map_landmark.position() - Point(1.5, 3.5)).norm(), 0.0, 0.1);
  EXPECT_NEAR(std::remainder(degrees(found->T_map_landmark.theta_rad), 90.0), 0.0, 16.0) << "as it stands in the map";
}

TEST_F(OfficeCapture, SaysWhatIsWrong) {
  const auto error = [&](const std::string& at, const std::string& category = "crate",
                         const std::string& radius = "0.8") {
    const Finished finished = capture(at, category, "bad.yaml", radius);
    EXPECT_EQ(finished.exit_status, 2);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "bad.yaml"));
    return finished.err;
  };
  EXPECT_THAT(error("nearest squares"), HasSubstr("did you mean \"square\"?"));
  EXPECT_THAT(error("2.5,2.5"),
              HasSubstr("nothing lies wholly within 0.80 m of (2.50, 2.50): what is there is too thin"));
  EXPECT_THAT(error("3,0"), HasSubstr("what is there is too thin or too small"));
  EXPECT_THAT(error("nearest square", "crate", "0.35"), HasSubstr("what is there goes on farther"));
  EXPECT_THAT(error("nearest square", "two words"), HasSubstr("bad.yaml:2:11: category must be a letter"));
  ASSERT_EQ(capture("nearest square", "crate", "twice.yaml").exit_status, 0);
  EXPECT_THAT(capture("nearest square", "crate", "twice.yaml").err, HasSubstr("there is such a file already"));
}

}  // namespace
}  // namespace cairn::testing_program
