// Sensed templates with the shipped modules: what is left out to save time changes nothing, and neither
// does the cache.
#include "framework/templates/sensed_templates.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>

#include "framework/files/robot_file.hpp"
#include "framework/files/template_file.hpp"
#include "framework/modules/module_library.hpp"
#include "framework/templates/landmark_orbit.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;

const fs::path kConfig = fs::path(CAIRN_SOURCE_DIR) / "config";

const ModuleLibrary& modules() {
  static const ModuleLibrary library({fs::path(CAIRN_BINARY_DIR) / "lib" / "cairn"});
  return library;
}

PluginChoice plain(const std::string& name) {
  PluginChoice choice{name, {}};
  choice.config.kind = ConfigValue::Kind::map;
  return choice;
}

const RobotModel& robot() {
  static const RobotModel model = load_robot(kConfig / "robots" / "pioneer1.yaml");
  return model;
}

class OrbitWith : public ::testing::TestWithParam<std::string> {};

TEST_P(OrbitWith, ReadingsThatDoNotComeNearChangeNothingThere) {
  const PluginChoice sensor = plain("simulated_robot");
  const PluginChoice map = plain(GetParam());
  const OrbitCrew crew{robot(), sensor, map, modules()};
  const Contour box = Contour::polygon({{0, 0}, {0.9, 0}, {0.9, 0.45}, {0, 0.45}});
  OrbitPlan plan;
  plan.orientation_rad = radians(30.0);
  const auto whole = map_of_orbits(crew, box, plan);
  plan.needed_m = 0.8;
  const auto part = map_of_orbits(crew, box, plan);
  int occupied = 0;
  for (int y = -16; y <= 16; ++y) {
    for (int x = -16; x <= 16; ++x) {
      if (std::hypot(x, y) * 0.05 > 0.75) continue;
      ASSERT_EQ(part->grid().log_odds({x, y}), whole->grid().log_odds({x, y})) << x << ", " << y;
      occupied += static_cast<int>(whole->grid().ol({x, y}) > 127);
    }
  }
  EXPECT_GT(occupied, 5) << "some of the outline is there; HIMM sees little of it";
}

INSTANTIATE_TEST_SUITE_P(ShippedMaps, OrbitWith, ::testing::Values("bayes", "muriel", "murphy", "himm"),
                         [](const auto& named) { return named.param; });

class Cache : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = fs::temp_directory_path() / ("cairn_cache_" + std::to_string(::getpid())); }
  void TearDown() override { fs::remove_all(folder_); }

  TemplateSet render(const std::vector<LandmarkShape>& shapes, const std::string& map = "bayes",
                     bool smooth_too = false) const {
    SensedOptions options;
    options.smooth_too = smooth_too;
    return render_sensed_set(shapes, radians(15.0), 0.05, options, robot(), plain("simulated_robot"), plain(map),
                             modules(), TemplateCache(folder_));
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

void expect_same(const TemplateSet& a, const TemplateSet& b) {
  ASSERT_EQ(a.templates.size(), b.templates.size());
  for (std::size_t i = 0; i < a.templates.size(); ++i) {
    EXPECT_EQ(a.templates[i].category, b.templates[i].category);
    EXPECT_EQ(a.templates[i].orientation_rad, b.templates[i].orientation_rad);
    EXPECT_EQ(a.templates[i].cells, b.templates[i].cells);
    EXPECT_EQ(a.templates[i].tolerance, b.templates[i].tolerance);
  }
}

TEST_F(Cache, GivesWhatRenderingGives) {
  const std::vector<LandmarkShape> shapes = load_landmark_shapes(kConfig / "templates");
  const TemplateSet fresh = render(shapes);
  EXPECT_EQ(fresh.templates.size(), 15U);
  EXPECT_EQ(files(), 3U);
  expect_same(render(shapes), fresh);
}

// A circle answers to all sides, a face to one.
TEST_F(Cache, SmoothFacesHaveTolerantTemplates) {
  const std::vector<LandmarkShape> shapes = load_landmark_shapes(kConfig / "templates");
  const TemplateSet set = render(shapes, "bayes", true);
  ASSERT_EQ(set.templates.size(), 1U + 2U * 6U + 2U * 8U);
  for (std::size_t i = 0; i < set.templates.size(); ++i) {
    const LandmarkTemplate& t = set.templates[i];
    const bool is_second = i > 0 && set.templates[i - 1].category == t.category &&
                           set.templates[i - 1].orientation_rad == t.orientation_rad;
    EXPECT_EQ(t.tolerance, is_second ? 1.2 : 1.0) << t.category << ' ' << i;
    EXPECT_FALSE(is_second && t.cells == set.templates[i - 1].cells) << t.category << ' ' << i;
  }
  expect_same(render(shapes, "bayes", true), set);
}

TEST_F(Cache, ALasersTemplatesAreOfRoughSurfacesOnly) {
  const RobotModel laser = load_robot(kConfig / "robots" / "turtlebot3.yaml");
  SensedOptions options;
  options.smooth_too = true;
  const TemplateSet set =
      render_sensed_set(load_landmark_shapes(kConfig / "templates"), radians(15.0), 0.05, options, laser,
                        plain("simulated_robot"), plain("bayes"), modules(), TemplateCache());
  EXPECT_EQ(set.templates.size(), 15U);
}

TEST_F(Cache, IsNotTakenInForAnotherShapeMapperOrCategory) {
  const LandmarkShape pillar{"pillar", Contour::circle(0.4)};
  const TemplateSet fresh = render({pillar});
  EXPECT_EQ(render({{"column", Contour::circle(0.4)}}).templates[0].category, "column");
  EXPECT_NE(render({{"pillar", Contour::circle(0.5)}}).templates[0].cells, fresh.templates[0].cells);
  EXPECT_NE(render({pillar}, "muriel").templates[0].cells, fresh.templates[0].cells);
  EXPECT_EQ(files(), 4U);
}

TEST_F(Cache, IgnoresAndReplacesABrokenFile) {
  const std::vector<LandmarkShape> shapes{{"pillar", Contour::circle(0.4)}};
  const TemplateSet fresh = render(shapes);
  const fs::path file = fs::directory_iterator(folder_)->path();
  std::ifstream in(file, std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(in), {}};
  for (const std::size_t cut : {std::size_t{0}, std::size_t{5}, good.size() / 2, good.size() - 1}) {
    std::ofstream(file, std::ios::binary) << good.substr(0, cut);
    expect_same(render(shapes), fresh);
    EXPECT_EQ(fs::file_size(file), good.size());
  }
  std::string flipped = good;
  flipped[good.size() - 20] ^= 1;  // in a gradient
  std::ofstream(file, std::ios::binary) << flipped;
  expect_same(render(shapes), fresh);
}

TEST_F(Cache, DoesWithoutAFolderThatCannotBeMade) {
  std::ofstream(folder_) << "a file in the way";
  EXPECT_EQ(render({{"pillar", Contour::circle(0.4)}}).templates.size(), 1U);
}

TEST_F(Cache, LoadsTwentyCategories) {
  std::vector<LandmarkShape> shapes = load_landmark_shapes(kConfig / "templates");
  for (LandmarkShape& shape : load_landmark_shapes(kConfig / "templates_extra")) shapes.push_back(std::move(shape));
  const std::size_t shipped = shapes.size();
  for (std::size_t i = 0; shapes.size() < 20; ++i) {
    const double length_m = 0.5 + 0.05 * static_cast<double>(i);
    shapes.push_back(
        {"crate" + std::to_string(i), Contour::polygon({{0, 0}, {length_m, 0}, {length_m, 0.35}, {0, 0.35}})});
  }
  ASSERT_LT(shipped, 20U);
  const auto timed = [&](const char* what) {
    const auto begin = std::chrono::steady_clock::now();
    const TemplateSet set = render(shapes);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    RecordProperty(what, std::to_string(ms));
    std::cout << what << ": " << set.templates.size() << " templates in " << ms << " ms\n";
    return set;
  };
  const TemplateSet cold = timed("cold");
  expect_same(timed("warm"), cold);
  EXPECT_EQ(files(), 20U);
}

}  // namespace
}  // namespace cairn
