#include "framework/files/world_file.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "framework/files/template_file.hpp"
#include "maps/geometry/segments.hpp"
#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

using config_test::error_of;
using config_test::TestFolder;

const std::filesystem::path kConfig = std::filesystem::path(CAIRN_SOURCE_DIR) / "config";

const std::vector<LandmarkShape>& shipped_shapes() {
  static const std::vector<LandmarkShape> kShapes = load_landmark_shapes(kConfig / "templates");
  return kShapes;
}

World load_text(const std::string& text) {
  const TestFolder folder;
  return load_world(folder.write("w.yaml", text), shipped_shapes());
}

std::string error_in(const std::string& text) {
  const TestFolder folder;
  const auto file = folder.write("w.yaml", text);
  return folder.without_folder(error_of([&] { (void)load_world(file, shipped_shapes()); }));
}

const std::string kBounds = "bounds_m: [[0, 0], [6, 5]]\n";

// Free space round a point: to walls and to every object but one.
double clearance_m(const World& world, const Point& p, const WorldObject* but = nullptr) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const WorldWall& wall : world.walls) {
    for (std::size_t i = 1; i < wall.points_m.size(); ++i) {
      nearest = std::min(nearest, distance_to_segment_m(p, wall.points_m[i - 1], wall.points_m[i]));
    }
  }
  for (const WorldObject& object : world.objects) {
    if (&object == but) continue;
    nearest = std::min(nearest, object.contour.signed_distance(inverse(object.T_map_object) * p));
  }
  return nearest;
}

// Points along an object's outline, in the map.
std::vector<Point> outline_of(const WorldObject& object) {
  std::vector<Point> points;
  if (object.contour.is_circle()) {
    for (int deg = 0; deg < 360; deg += 5) {
      const double r = object.contour.circle_diameter_m / 2;
      points.push_back(object.T_map_object * Point(r * std::cos(radians(deg)), r * std::sin(radians(deg))));
    }
    return points;
  }
  const std::vector<Point>& corners = object.contour.polygons_m.front();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& next = corners[(i + 1) % corners.size()];
    for (int k = 0; k < 10; ++k)
      points.push_back(object.T_map_object * Point(corners[i] + (next - corners[i]) * k / 10.0));
  }
  return points;
}

TEST(WorldFile, EveryShippedWorldLoadsAndLetsTheRobotRoundItsLandmarks) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kConfig / "worlds")) {
    SCOPED_TRACE(entry.path());
    const World world = load_world(entry.path(), shipped_shapes());
    EXPECT_FALSE(world.walls.empty());
    ++files;
    if (entry.path().filename() == "twins.yaml") continue;  // a hall of landmarks that stand too near to each other
    for (const WorldObject& object : world.objects) {
      if (object.category.empty()) continue;
      for (const Point& p : outline_of(object)) {
        EXPECT_GE(clearance_m(world, p, &object), 0.8) << object.category << " at " << p.transpose();
      }
    }
  }
  EXPECT_GE(files, 4);
}

TEST(WorldFile, TheOfficeIsThePapersRoom) {
  const World world = load_world(kConfig / "worlds" / "office.yaml", shipped_shapes());
  EXPECT_EQ(world.min_m, Point(0, 0));
  EXPECT_EQ(world.max_m, Point(6, 5));
  std::vector<std::string> categories;
  for (const WorldObject& object : world.objects) categories.push_back(object.category);
  EXPECT_EQ(categories, (std::vector<std::string>{"square", "circle", "triangle", ""}));
  EXPECT_EQ(world.objects[0].T_map_object, (Pose2{1.5, 3.5, radians(15.0)}));
  EXPECT_EQ(world.walls.at(0).surface, Surface::rough);
  EXPECT_GE(clearance_m(world, {0.6, 0.6}), 0.5) << "the start";
}

TEST(WorldFile, TheHallwaysStartIsFree) {
  const World world = load_world(kConfig / "worlds" / "hallway.yaml", shipped_shapes());
  EXPECT_GE(clearance_m(world, {0.8, 1.2}), 0.7);
}

TEST(WorldFile, WallsAreSmoothAndObjectsRoughUnlessTheySayOtherwise) {
  const World world = load_text(kBounds +
                                "walls: [{points_m: [[0, 0], [1, 0]]}, {points_m: [[0, 1], [1, 1]], surface: rough}]\n"
                                "objects: [{circle_diameter_m: 0.3, at_m: [4, 1]},\n"
                                "          {circle_diameter_m: 0.3, at_m: [5, 1], surface: smooth}]\n");
  EXPECT_EQ(world.walls[0].surface, Surface::smooth);
  EXPECT_EQ(world.walls[1].surface, Surface::rough);
  EXPECT_EQ(world.objects[0].surface, Surface::rough);
  EXPECT_EQ(world.objects[1].surface, Surface::smooth);
}

TEST(WorldFile, ObjectsStandWhereTheySay) {
  const World world =
      load_text(kBounds +
                "objects:\n"
                "  - {template: triangle, at_m: [1, 2], angle_deg: 270}\n"
                "  - {polygon_m: [[3, 1], [3.4, 1], [3.2, 1.5]]}\n"
                "  - {polygon_m: [[10, 10], [12, 10], [12, 11], [10, 11]], at_m: [2, 3], angle_deg: 90}\n");
  EXPECT_EQ(world.objects[0].category, "triangle");
  EXPECT_EQ(world.objects[0].contour, shipped_shapes()[2].contour);
  EXPECT_DOUBLE_EQ(world.objects[0].T_map_object.theta_rad, radians(-90.0));
  EXPECT_EQ(world.objects[1].category, "");
  EXPECT_EQ(world.objects[1].contour.polygons_m[0][0], Point(3, 1)) << "corners in the map";
  EXPECT_EQ(world.objects[1].T_map_object, Pose2{});
  EXPECT_EQ(world.objects[2].contour.polygons_m[0][0], Point(-1, -0.5)) << "corners about the centroid";
  EXPECT_EQ(world.objects[2].T_map_object, (Pose2{2, 3, radians(90.0)}));
}

TEST(WorldFile, TagsHangWhereTheySay) {
  const World world = load_text(kBounds +
                                "tags:\n"
                                "  - {id: 7, at_m: [3, 0], facing_deg: 90}\n"
                                "  - {id: 2114, family: standard41h12, at_m: [6, 2], facing_deg: 180, height_m: 1.2, "
                                "size_m: 0.25}\n");
  ASSERT_EQ(world.tags.size(), 2U);
  EXPECT_EQ(world.tags[0].marker, (MarkerId{MarkerFamily::tag36h11, 7}));
  EXPECT_EQ(world.tags[0].T_map_tag, (Pose2{3.0, 0.0, radians(90.0)}));
  EXPECT_EQ(world.tags[0].height_m, WorldTag{}.height_m);
  EXPECT_EQ(world.tags[0].size_m, WorldTag{}.size_m);
  EXPECT_EQ(world.tags[1].marker, (MarkerId{MarkerFamily::tagStandard41h12, 2114}));
  EXPECT_EQ(world.tags[1].height_m, 1.2);
  EXPECT_EQ(world.tags[1].size_m, 0.25);
}

TEST(WorldFile, SaysWhatIsWrongWithATag) {
  const auto tag_error = [](const std::string& tag) { return error_in(kBounds + "tags: [" + tag + "]\n"); };
  EXPECT_EQ(tag_error("{id: 1, at_m: [7, 0], facing_deg: 0}"),
            "w.yaml:2:22: at_m [7, 0] lies outside bounds_m [0, 0] to [6, 5]");
  EXPECT_EQ(tag_error("{id: 587, at_m: [1, 0], facing_deg: 0}"),
            "w.yaml:2:13: family 36h11 has the ids 0 to 586, found 587");
  EXPECT_EQ(tag_error("{id: 35, family: 25h9, at_m: [1, 0], facing_deg: 0}"),
            "w.yaml:2:13: family 25h9 has the ids 0 to 34, found 35");
  EXPECT_EQ(tag_error("{id: 1, at_m: [1, 0], facing_deg: 0, height_m: 0.05}"),
            "w.yaml:2:8: the tag's lower edge is below the floor: height_m is of its centre");
  EXPECT_THAT(tag_error("{id: 1, family: 16h5, at_m: [1, 0], facing_deg: 0}"), testing::HasSubstr("36h11"));
  EXPECT_THAT(tag_error("{id: 1, at_m: [1, 0]}"), testing::HasSubstr("lacks the key \"facing_deg\""));
}

TEST(WorldFile, SaysWhatIsWrongWithTheBounds) {
  EXPECT_EQ(error_in("walls: []\n"),
            "w.yaml:1:1: world lacks the key \"bounds_m\": lower left and upper right corner of the world");
  EXPECT_EQ(error_in("bounds_m: [[0, 0]]\n"), "w.yaml:1:11: bounds_m must be two points [[x, y], [x, y]], found 1");
  EXPECT_EQ(error_in("bounds_m: [[0, 0], [6, -5]]\n"),
            "w.yaml:1:11: bounds_m must go from the lower left to the upper right corner, found [0, 0] to [6, -5]");
  EXPECT_EQ(
      error_in(kBounds + "wals: []\n"),
      "w.yaml:2:1: unknown key \"wals\" in world (did you mean \"walls\"?); known: bounds_m, walls, objects, doors, "
      "movers, tags");
}

TEST(WorldFile, SaysWhatIsWrongWithAWall) {
  EXPECT_EQ(error_in(kBounds + "walls: [{points_m: [[0, 0]]}]\n"),
            "w.yaml:2:20: a wall needs at least 2 points, found 1");
  EXPECT_EQ(error_in(kBounds + "walls: [{points_m: [[0, 0], [7, 0]]}]\n"),
            "w.yaml:2:29: the wall's point [7, 0] lies outside bounds_m [0, 0] to [6, 5]");
  EXPECT_EQ(error_in(kBounds + "walls: [{points_m: [[0, 0], [0, 0]]}]\n"),
            "w.yaml:2:29: a wall's point stands here twice: [0, 0]");
  EXPECT_EQ(error_in(kBounds + "walls: [{points_m: [[0, 0], [1, 0]], surface: shiny}]\n"),
            "w.yaml:2:47: surface must be one of smooth, rough, found \"shiny\"");
  EXPECT_EQ(error_in(kBounds + "walls: [{surface: rough}]\n"),
            "w.yaml:2:9: walls lacks the key \"points_m\": the corners along the wall");
}

TEST(WorldFile, SaysWhatIsWrongWithAnObject) {
  const auto object_error = [](const std::string& object) { return error_in(kBounds + "objects: [" + object + "]\n"); };
  EXPECT_EQ(object_error("{template: sqare, at_m: [1, 1]}"),
            "w.yaml:2:22: no template of the category \"sqare\" (did you mean \"square\"?); known: circle, square, "
            "triangle");
  EXPECT_EQ(object_error("{at_m: [1, 1]}"),
            "w.yaml:2:11: an object needs one of template, circle_diameter_m, polygon_m");
  EXPECT_EQ(object_error("{template: square, circle_diameter_m: 1, at_m: [1, 1]}"),
            "w.yaml:2:30: an object takes only one of template, circle_diameter_m, polygon_m, found both \"template\" "
            "and \"circle_diameter_m\"");
  EXPECT_EQ(object_error("{template: square}"), "w.yaml:2:11: an object with template needs at_m");
  EXPECT_EQ(object_error("{circle_diameter_m: 1}"), "w.yaml:2:11: an object with circle_diameter_m needs at_m");
  EXPECT_EQ(object_error("{template: square, at_m: [7, 1]}"),
            "w.yaml:2:36: at_m [7, 1] lies outside bounds_m [0, 0] to [6, 5]");
  EXPECT_EQ(object_error("{polygon_m: [[3, 1], [9, 1], [3, 2]]}"),
            "w.yaml:2:32: the corner [9, 1] lies outside bounds_m [0, 0] to [6, 5]");
  EXPECT_EQ(object_error("{polygon_m: [[3, 1], [4, 1], [3, 2]], angle_deg: 5}"),
            "w.yaml:2:60: angle_deg needs at_m, the point to turn on");
  EXPECT_EQ(object_error("{polygon_m: [[3, 1], [4, 1]]}"),
            "w.yaml:2:23: polygon_m: a polygon needs at least 3 corners, this one has 2");
  EXPECT_EQ(object_error("{circle_diameter_m: .nan, at_m: [1, 1]}"),
            "w.yaml:2:31: circle_diameter_m must be a number from 0.01 to 100 m, found \".nan\"");
}

TEST(WorldFile, WithoutTemplatesNoCategoryIsKnown) {
  const TestFolder folder;
  const auto file = folder.write("w.yaml", kBounds + "objects: [{template: square, at_m: [1, 1]}]\n");
  EXPECT_EQ(folder.without_folder(error_of([&] { (void)load_world(file, {}); })),
            "w.yaml:2:22: no template of the category \"square\"; known: none");
}

// Every file of ours with a few bytes changed: an error with a place, or still a world.
TEST(WorldFile, ADamagedWorldIsReadOrRefused) {
  const TestFolder folder;
  std::ifstream stream(kConfig / "worlds" / "two_rooms.yaml");
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    std::string text = whole;
    for (int n = 0; n < 3; ++n) text[random() % text.size()] = "0123456789.-[]{}:, \nabe"[random() % 23];
    const auto file = folder.write("w.yaml", text);
    try {
      (void)load_world(file, shipped_shapes());
    } catch (const ConfigError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(file.string() + ":")) << error.what();
    }
  }
}

}  // namespace
}  // namespace cairn
