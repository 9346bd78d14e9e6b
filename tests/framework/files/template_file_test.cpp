#include "framework/files/template_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

using config_test::error_of;
using config_test::TestFolder;

const std::filesystem::path kTemplates = std::filesystem::path(CAIRN_SOURCE_DIR) / "config" / "templates";

std::string error_in(const std::string& text) {
  const TestFolder folder;
  const auto file = folder.write("t.yaml", text);
  return folder.without_folder(error_of([&] { (void)load_landmark_shape(file); }));
}

TEST(TemplateFile, TheShippedTemplatesAreThePapersShapes) {
  const std::vector<LandmarkShape> shapes = load_landmark_shapes(kTemplates);
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_EQ(shapes[0].category, "circle");
  EXPECT_EQ(shapes[0].contour, Contour::circle(0.5));
  EXPECT_EQ(shapes[1].category, "square");
  EXPECT_NEAR(shapes[1].contour.inner_diameter_m(), 0.5, 1e-9);
  EXPECT_NEAR(shapes[1].contour.outer_diameter_m(), 0.5 * std::sqrt(2.0), 1e-9);
  EXPECT_EQ(shapes[2].category, "triangle");
  EXPECT_NEAR(shapes[2].contour.inner_diameter_m(), 0.6 / std::sqrt(3.0), 1e-6) << "equilateral, about its centroid";
  EXPECT_NEAR(shapes[2].contour.outer_diameter_m(), 1.2 / std::sqrt(3.0), 1e-6);
}

TEST(TemplateFile, APolygonIsCentred) {
  const TestFolder folder;
  const LandmarkShape shape =
      load_landmark_shape(folder.write("t.yaml", "category: box\npolygon_m: [[5, 5], [5, 7], [6, 7], [6, 5]]\n"));
  EXPECT_EQ(shape.contour, Contour::polygon({{0.5, -1}, {0.5, 1}, {-0.5, 1}, {-0.5, -1}}));
}

TEST(TemplateFile, SaysWhatIsWrong) {
  EXPECT_EQ(error_in("circle: {diameter_m: 1}\n"),
            "t.yaml:1:1: template lacks the key \"category\": what landmarks of this shape are called");
  EXPECT_EQ(error_in("category: a\n"), "t.yaml:1:1: template needs one of circle, polygon_m, parts, picture");
  EXPECT_EQ(error_in("category: a\ncircle: {diameter_m: 1}\npolygon_m: []\n"),
            "t.yaml:3:1: template takes only one of circle, polygon_m, parts, picture, found both \"circle\" and "
            "\"polygon_m\"");
  EXPECT_EQ(error_in("category: a\ncircle: {diameter_m: 0}\n"),
            "t.yaml:2:22: diameter_m must be a number from 0.01 to 100 m, found \"0\"");
  EXPECT_EQ(error_in("category: a\ncircle: {}\n"), "t.yaml:2:9: circle lacks the key \"diameter_m\": how wide it is");
  EXPECT_EQ(error_in("category: a\ncircle: {diameter: 1}\n"),
            "t.yaml:2:10: unknown key \"diameter\" in circle (did you mean \"diameter_m\"?); known: diameter_m");
  EXPECT_EQ(error_in("category: a\npolygon_m: [[0, 0], [1, 1], [1, 0], [0, 1]]\n").substr(0, 24),
            "t.yaml:2:12: polygon_m: ");
  EXPECT_EQ(error_in("category: a\npolygon_m: [[0, 0], [1, 1], [2, 2]]\n"),
            "t.yaml:2:12: polygon_m: the polygon has no area: its corners lie in one line");
}

TEST(TemplateFile, TheShippedFamilyLoads) {
  const auto extra = std::filesystem::path(CAIRN_SOURCE_DIR) / "config" / "templates_extra";
  std::string categories;
  for (const LandmarkShape& shape : load_landmark_shapes(extra)) {
    categories += shape.category + " ";
    EXPECT_GE(shape.contour.outer_diameter_m(), 0.25) << shape.category << " does not fill a coarse cell";
    EXPECT_EQ(shape.contour.outlines_m(8).size(), shape.category == "bench" || shape.category == "door_frame" ? 2 : 1);
  }
  EXPECT_EQ(categories, "bench box cross door_frame l_corner pillar t_piece ");
}

TEST(TemplateFile, BulgesBendSides) {
  const TestFolder folder;
  // A unit square whose upper side is half a circle outward: higher by half a metre.
  const LandmarkShape dome = load_landmark_shape(
      folder.write("t.yaml", "category: dome\npolygon_m: [[0, 0], [1, 0], [1, 1], [0, 1]]\nbulges: [0, 0, 1, 0]\n"));
  const std::vector<Point>& corners = dome.contour.polygons_m.front();
  EXPECT_GT(corners.size(), 12U);
  const auto [low, high] = std::ranges::minmax(corners, {}, [](const Point& p) { return p.y(); });
  EXPECT_NEAR(high.y() - low.y(), 1.5, 0.001);
}

TEST(TemplateFile, PartsStandWhereTheFileSays) {
  const TestFolder folder;
  const LandmarkShape gate =
      load_landmark_shape(folder.write("t.yaml",
                                       "category: gate\nparts:\n"
                                       "  - {circle: {diameter_m: 0.2}, at_m: [7, 1]}\n"
                                       "  - {polygon_m: [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]], "
                                       "at_m: [8, 1]}\n"));
  ASSERT_EQ(gate.contour.polygons_m.size(), 2U);
  EXPECT_NEAR(gate.contour.signed_distance(gate.contour.polygons_m[1][0] + Point(0.1, 0.1)), -0.1, 1e-9);
  EXPECT_NEAR(gate.contour.signed_distance(gate.contour.polygons_m[1][0] + Point(-0.9, 0.1)), -0.1, 0.001)
      << "the round post's middle";
}

TEST(TemplateFile, SaysWhatIsWrongWithArcsPartsAndPictures) {
  EXPECT_EQ(error_in("category: a\npolygon_m: [[0, 0], [1, 0], [0, 1]]\nbulges: [1]\n"),
            "t.yaml:3:9: bulges: needs one number for each corner's side, 3, found 1");
  EXPECT_EQ(error_in("category: a\ncircle: {diameter_m: 1}\nbulges: [1]\n"),
            "t.yaml:3:9: bulges bend the sides of polygon_m, which is not here");
  EXPECT_EQ(error_in("category: a\npolygon_m: [[0, 0], [1, 0], [0, 0.2]]\nbulges: [-1, 0, 0]\n").substr(0, 46),
            "t.yaml:2:12: polygon_m: the polygon crosses it");
  EXPECT_EQ(error_in("category: a\nparts: []\n"), "t.yaml:2:8: parts: an outline needs at least one part");
  EXPECT_EQ(error_in("category: a\nparts: [{circle: {diameter_m: 1}}, {circle: {diameter_m: 1}, at_m: [0.9, 0]}]\n"),
            "t.yaml:2:8: parts: part 2 meets part 1; parts must stand apart, draw what touches as one outline");
  EXPECT_EQ(error_in("category: a\nparts: [{at_m: [0, 0]}]\n"), "t.yaml:2:9: a part needs one of circle, polygon_m");
  EXPECT_EQ(error_in("category: a\nparts:\n  - {polygon_m: [[0, 0], [1, 1], [2, 2]]}\n"),
            "t.yaml:3:17: polygon_m: the polygon has no area: its corners lie in one line");
  EXPECT_EQ(error_in("category: a\npicture: {file: gone.png, cell_m: 0.1}\n"),
            "t.yaml:2:10: picture: no such picture: gone.png");
  EXPECT_EQ(error_in("category: a\npicture: {file: t.yaml, cell_m: 0.1}\n").substr(0, 49),
            "t.yaml:2:10: picture: t.yaml is not a PNG picture");
  EXPECT_EQ(error_in("category: a\npolygon_m: [[0, 0], [300, 0], [0, 300]]\n").substr(0, 62),
            "t.yaml:2:12: polygon_m must be from 0.01 to 100 m across, is 4");
}

TEST(TemplateFile, CategoriesArePlainWords) {
  for (const std::string category : {"\"\"", "two words", "5", "a/b", "a,b", "\"a\\nb\"", "_a"}) {
    const std::string error = error_in("category: " + category + "\ncircle: {diameter_m: 1}\n");
    EXPECT_TRUE(
        error.starts_with("t.yaml:1:11: category must be a letter and up to 63 letters, digits, _ or -, found \""))
        << error;
  }
}

TEST(TemplateFile, AFolderIsSortedByCategory) {
  const TestFolder folder;
  (void)folder.write("1.yaml", "category: zebra\ncircle: {diameter_m: 1}\n");
  (void)folder.write("2.yaml", "category: ant\ncircle: {diameter_m: 2}\n");
  (void)folder.write("notes.txt", "no template");
  (void)folder.write(".hidden.yaml", "no template");
  const std::vector<LandmarkShape> shapes = load_landmark_shapes(folder.path());
  ASSERT_EQ(shapes.size(), 2U);
  EXPECT_EQ(shapes[0].category, "ant");
  EXPECT_EQ(shapes[1].category, "zebra");
}

TEST(TemplateFile, SaysWhatIsWrongWithAFolder) {
  const TestFolder folder;
  const auto loading = [&](const std::string& name) {
    return folder.without_folder(error_of([&] { (void)load_landmark_shapes(folder.path() / name); }));
  };
  EXPECT_EQ(loading("gone"), "gone: no such folder of templates");
  std::filesystem::create_directories(folder.path() / "empty");
  EXPECT_EQ(loading("empty"), "empty: no template in this folder; a template is a file *.yaml");
  (void)folder.write("twice/a.yaml", "category: box\ncircle: {diameter_m: 1}\n");
  (void)folder.write("twice/b.yaml", "circle: {diameter_m: 1}\ncategory: box\n");
  EXPECT_EQ(loading("twice"), "twice/b.yaml:2:11: the category \"box\" is taken by twice/a.yaml");
  EXPECT_EQ(loading("twice/a.yaml"), "twice/a.yaml: a file, not a folder of templates");
  for (std::size_t i = 0; i <= kMaxTemplateFiles; ++i) (void)folder.write("many/" + std::to_string(i) + ".yaml", "");
  EXPECT_EQ(loading("many"), "many: holds 501 templates; at most 500 categories can be distinguished at a time");
}

}  // namespace
}  // namespace cairn
