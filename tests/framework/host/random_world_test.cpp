#include "framework/host/random_world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "framework/config/world_file.hpp"

namespace cairn {
namespace {

std::vector<LandmarkShape> shapes() {
  return {{"circle", Contour::circle(0.5)}, {"square", Contour::polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}})}};
}

World loaded(const std::string& text) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "random_world.yaml";
  std::ofstream(file) << text;
  return load_world(file, shapes());
}

TEST(RandomWorld, LoadsAndKeepsItsGapsOnEverySeed) {
  const RandomWorldConfig config;
  std::set<std::string> categories;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const World world = loaded(random_world_yaml(config, shapes(), 0.3, seed));
    int landmarks = 0;
    for (std::size_t i = 0; i < world.objects.size(); ++i) {
      const WorldObject& a = world.objects[i];
      const Point at_m = a.T_map_object.position();
      const double radius_m = 0.5 * a.contour.outer_diameter_m();
      categories.insert(a.category);
      landmarks += a.category.empty() ? 0 : 1;
      if (!a.category.empty()) {
        EXPECT_NEAR(radius_m, a.category == "circle" ? 0.25 : 0.3536, 0.0361);
      }
      EXPECT_GT((at_m - config.start_m).norm(), radius_m + config.start_gap_m - 1e-3);
      EXPECT_GT((at_m - world.min_m).minCoeff(), radius_m + config.gap_m - 2e-3);
      EXPECT_GT((world.max_m - at_m).minCoeff(), radius_m + config.gap_m - 2e-3);
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT((at_m - world.objects[k].T_map_object.position()).norm(),
                  radius_m + 0.5 * world.objects[k].contour.outer_diameter_m() + config.gap_m - 3e-3)
            << "seed " << seed;
    }
    EXPECT_GE(landmarks, config.least_landmarks);
    EXPECT_LE(landmarks, config.most_landmarks);
  }
  EXPECT_THAT(categories, testing::ElementsAre("", "circle", "square"));
}

TEST(RandomWorld, TheSpecularRatioChangesSurfacesOnly) {
  const std::string rough = random_world_yaml({}, shapes(), 0.0, 7);
  const std::string smooth = random_world_yaml({}, shapes(), 1.0, 7);
  EXPECT_THAT(rough, testing::Not(testing::HasSubstr("smooth")));
  EXPECT_EQ(std::regex_replace(smooth, std::regex("smooth"), "rough"), rough);
  EXPECT_NE(random_world_yaml({}, shapes(), 0.0, 8), rough);
}

}  // namespace
}  // namespace cairn
