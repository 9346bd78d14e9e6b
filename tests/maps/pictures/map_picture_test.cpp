#include "maps/pictures/map_picture.hpp"

#include "maps/pictures/coarse_picture.hpp"
#include "maps/pictures/drawing/label_placer.hpp"
#include "maps/pictures/robot_layer.hpp"
#include "maps/pictures/template_sheet.hpp"
#include "tests/maps/pictures/picture_fixture.hpp"

namespace cairn {
namespace {

using pictures::PixelBox;
using testing::HasSubstr;

// 6 x 5 m: walls round free floor, an unknown corner at the upper right.
OccupancyGrid room() {
  OccupancyGrid grid(0.05);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 120; ++x) {
      const bool is_wall = x < 2 || y < 2 || x >= 118 || y >= 98;
      const bool is_unknown = !is_wall && x > 90 && y > 70;
      if (!is_unknown) grid.set_log_odds({x, y}, is_wall ? 1024 : -1024);
    }
  return grid;
}

std::vector<LandmarkShape> shapes() {
  return {{"circle", Contour::circle(0.5)}, {"square", Contour::polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}})}};
}

LandmarkGraph graph() {
  LandmarkGraph graph;
  for (const auto& [category, x_m] : {std::pair{"circle", 1.5}, {"square", 4.0}, {"door", 2.5}}) {
    Landmark landmark;
    landmark.category = category;
    landmark.T_map_landmark = {x_m, 2.0, 0.3};
    landmark.degree = 0.74;
    graph.add(landmark);
  }
  graph.add_route({0, 1, 2, 2.5, {{1.5, 1.5, 0}, {4.0, 1.5, 0}}, true, false, 0, {}, {}});
  graph.add_route({0, 2, 3, 2.5, {}, false, false, 0, {}, {}});
  graph.add_route({0, 3, 1, 2.5, {}, false, true, 0, {}, {}});
  return graph;
}

class MapPictures : public Pictures {
 protected:
  [[nodiscard]] Png drawn(const MapPicture& picture) const {
    write_map_picture(file(), picture);
    return read_png(file());
  }

  OccupancyGrid room_ = room();
  LandmarkGraph graph_ = graph();
};

TEST_F(MapPictures, AreAboutAThousandPixelsOnTheLongerSide) {
  MapPicture picture;
  picture.grid = &room_;
  const Png wide = drawn(picture);
  EXPECT_NEAR(wide.width, 960, 60);
  EXPECT_LT(wide.height, wide.width);
  OccupancyGrid corridor(0.05);
  for (int y = 0; y < 4000; ++y) corridor.set_log_odds({y % 300, y}, -1024);
  picture.grid = &corridor;
  EXPECT_NEAR(drawn(picture).height, 1040, 70);
}

TEST_F(MapPictures, ShowFreeWhiteUnknownGreyOccupiedBlack) {
  MapPicture picture;
  picture.grid = &room_;
  const Png png = drawn(picture);
  const Colour free = pictures::colour_of_ol(room_.ol({50, 50}));
  const Colour unknown = pictures::colour_of_ol(kUnknownOl);
  const Colour occupied = pictures::colour_of_ol(room_.ol({0, 0}));
  EXPECT_GT(free.red, 245);
  EXPECT_NEAR(unknown.red, 200, 20);
  EXPECT_LT(occupied.red, 40);
  EXPECT_GT(png.count(free), 300'000);
  EXPECT_GT(png.count(unknown), 30'000);
  EXPECT_GT(png.count(occupied), 20'000);
}

TEST_F(MapPictures, InThreeGreysHaveNothingBetweenThem) {
  for (int y = 20; y < 80; ++y)
    for (int x = 20; x < 100; ++x) room_.set_log_odds({x, y}, static_cast<LogOdds>(-900 + 7 * x));
  MapPicture picture;
  picture.grid = &room_;
  const Png fine = drawn(picture);
  const auto fine_bytes = fs::file_size(file());
  picture.has_three_greys = true;
  const Png coarse = drawn(picture);
  EXPECT_LT(fs::file_size(file()), fine_bytes);
  const long fine_free = fine.count(pictures::colour_of_ol(0));
  EXPECT_GT(coarse.count(pictures::colour_of_ol(0)), fine_free + 100'000);
  EXPECT_GT(coarse.count(pictures::colour_of_ol(255)), 20'000);
}

TEST_F(MapPictures, TintAreasAndWriteInThem) {
  MapPicture picture;
  picture.grid = &room_;
  const Png bare = drawn(picture);
  picture.areas = {{{1.0, 1.0}, {4.0, 3.0}, "not entered"}};
  const Png tinted = drawn(picture);
  EXPECT_EQ(bare.count(pictures::kGoal), 0);
  EXPECT_GT(tinted.count(pictures::kGoal), 50) << "the words";
  const Pixel walls = bare.centre_of(pictures::colour_of_ol(room_.ol({0, 0})));
  const auto at = [&](const Png& png, double x_m, double y_m) {
    const double px_per_m = 155.0;  // about: the picture is 930 pixels for 6 m
    return png.at(static_cast<int>(walls.x() + (x_m - 3.0) * px_per_m),
                  static_cast<int>(walls.y() - (y_m - 2.5) * px_per_m));
  };
  EXPECT_FALSE(at(tinted, 1.5, 2.6) == at(bare, 1.5, 2.6));
  EXPECT_TRUE(at(tinted, 4.6, 1.5) == at(bare, 4.6, 1.5)) << "beside the area";
  picture.areas = {{{kNan, 0.0}, {1.0, 1.0}, "nowhere"}};
  EXPECT_EQ(drawn(picture).count(pictures::kGoal), 0);
}

TEST_F(MapPictures, HaveNorthUpAndEastRight) {
  OccupancyGrid grid(0.05);
  grid.include({{0, 0}, {100, 100}});
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) grid.set_log_odds({x, y}, x > 80 && y > 80 ? 1024 : -1024);
  MapPicture picture;
  picture.grid = &grid;
  const Png png = drawn(picture);
  const Pixel dark = png.centre_of(pictures::colour_of_ol(grid.ol({99, 99})));
  EXPECT_GT(dark.x(), 0.75 * png.width);
  EXPECT_LT(dark.y(), 0.25 * png.height);
}

TEST_F(MapPictures, DrawAPlaceWhereItIs) {
  MapPicture picture;
  picture.grid = &room_;
  picture.robot = Pose2{3.0, 2.5, 0.0};
  picture.robot_radius_m = 0.3;
  const Png without = drawn(picture);
  picture.goal = Point(3.0, 2.5);  // the middle of the room
  const Png png = drawn(picture);
  const Pixel walls = png.centre_of(pictures::colour_of_ol(room_.ol({0, 0})));
  EXPECT_EQ(without.count(pictures::kGoal), 0);
  // The same sign stands in the legend: its colour counts in the map alone.
  double x_sum = 0;
  double y_sum = 0;
  int n = 0;
  for (int y = 60; y < png.height - 90; ++y)
    for (int x = 0; x < png.width; ++x)
      if (png.at(x, y) == pictures::kGoal) {
        x_sum += x;
        y_sum += y;
        ++n;
      }
  ASSERT_GT(n, 10);
  EXPECT_NEAR(x_sum / n, walls.x(), 15);
  EXPECT_NEAR(y_sum / n, walls.y(), 25);
}

TEST_F(MapPictures, DrawWhatIsGivenAndNothingElse) {
  MapPicture picture;
  picture.grid = &room_;
  const Png bare = drawn(picture);
  for (const Colour colour : {pictures::kPlanned, pictures::kStart, pictures::kGoal, pictures::category_colour(0)})
    EXPECT_EQ(bare.count(colour), 0);
  picture.graph = &graph_;
  picture.shapes = shapes();
  picture.driven = {{0.5, 0.5}, {5.0, 0.5}, {5.0, 3.0}};
  picture.planned = {{0.5, 0.5}, {3.0, 3.0}};
  picture.start = Point(0.5, 0.5);
  picture.goal = Point(3.0, 3.0);
  picture.robot = Pose2{5.0, 3.0, 1.0};
  picture.robot_radius_m = 0.22;
  const Png full = drawn(picture);
  EXPECT_GT(full.count(pictures::kStart), 20);
  EXPECT_GT(full.count(pictures::kGoal), 20);
  for (std::size_t category = 0; category < 3; ++category)
    EXPECT_GT(full.count(pictures::category_colour(category)), 20) << category;
  EXPECT_GT(full.height, bare.height) << "the legend grows with what is drawn";
}

// The pixels of the map, without legend and title, that differ.
PixelBox box_of_differences(const Png& a, const Png& b) {
  PixelBox box{{1e9, 1e9}, {-1e9, -1e9}};
  for (int y = 60; y < std::min(a.height, b.height) - 90; ++y)
    for (int x = 0; x < a.width; ++x)
      if (a.at(x, y) != b.at(x, y)) {
        box.min = box.min.cwiseMin(Pixel(x, y));
        box.max = box.max.cwiseMax(Pixel(x, y));
      }
  return box;
}

TEST_F(MapPictures, DrawTheRobotAsItStandsOnItsWay) {
  MapPicture picture;
  picture.grid = &room_;
  picture.robot_path = {{3.0, 2.5, radians(90.0)}};
  picture.robot_radius_m = 1.0;
  picture.robot_polygon_m = {{-0.5, -0.25}, {1.0, -0.25}, {1.0, 0.25}, {-0.5, 0.25}};
  MapPicture without = picture;
  without.robot_path.clear();
  const Png bare = drawn(without);
  const double px_per_m = 930.0 / 6.5;  // about: of walls, and a margin of 5 cells
  const PixelBox car = box_of_differences(bare, drawn(picture));
  EXPECT_NEAR(car.width(), 0.5 * px_per_m, 6);  // it looks up
  EXPECT_NEAR(car.height(), 1.5 * px_per_m, 10);
  picture.robot_polygon_m.clear();
  const PixelBox disc = box_of_differences(bare, drawn(picture));
  EXPECT_NEAR(disc.width(), 2.0 * px_per_m, 10);
  EXPECT_NEAR(disc.height(), disc.width(), 2);
  picture.robot_radius_m = 0.0;
  EXPECT_LT(box_of_differences(bare, drawn(picture)).width(), 0);
}

TEST(RobotLayer, SpreadsThePosesEvenlyAndKeepsBothEnds) {
  const std::vector<Pose2> corner{{0, 0, 0}, {4, 0, 0}, {4, 0, radians(90)}, {4, 6, radians(90)}};
  const std::vector<Pose2> chosen = pictures::spread_along(corner, 1.9);
  ASSERT_EQ(chosen.size(), 6U);  // 10 m in 5 steps
  EXPECT_EQ(chosen.front(), corner.front());
  EXPECT_EQ(chosen.back(), corner.back());
  EXPECT_TRUE(chosen[1].position().isApprox(Point(2, 0)));
  EXPECT_TRUE(chosen[4].position().isApprox(Point(4, 4)));
  EXPECT_NEAR(chosen[4].theta_rad, radians(90), 1e-9);
  EXPECT_EQ(pictures::spread_along(corner, 100.0).size(), 2U);
  EXPECT_EQ(pictures::spread_along({{1, 1, 0}}, 1.0).size(), 1U);
  EXPECT_TRUE(pictures::spread_along({}, 1.0).empty());
  EXPECT_TRUE(pictures::spread_along({{0, 0, 0}, {kNan, 0, 0}}, 1.0).empty());
}

TEST_F(MapPictures, OfTheSameInputAreTheSameBytes) {
  MapPicture picture;
  picture.grid = &room_;
  picture.graph = &graph_;
  picture.shapes = shapes();
  picture.title = "twice";
  picture.driven = {{0.5, 0.5}, {5.0, 0.5}, {5.0, 3.0}};
  write_map_picture(file("a.png"), picture);
  write_map_picture(file("b.png"), picture);
  EXPECT_EQ(bytes_of(file("a.png")), bytes_of(file("b.png")));
}

TEST_F(MapPictures, SurviveNothingAndNonsense) {
  EXPECT_GT(drawn({}).width, 400);
  const OccupancyGrid empty(0.05);
  MapPicture picture;
  picture.grid = &empty;
  EXPECT_GT(drawn(picture).width, 400);
  picture.driven = {{kNan, 0.0}, {1.0, 1.0}, {1e300, 2.0}, {2.0, 2.0}};
  picture.planned = {{0.0, std::numeric_limits<double>::infinity()}};
  picture.start = Point(kNan, kNan);
  picture.robot = Pose2{1e300, kNan, kNan};
  picture.robot_path = {{1e300, kNan, 0.0}, {1.0, 1.0, kNan}};
  picture.title = std::string(500, 'x') + "\xC3\xA4\n";
  EXPECT_GT(drawn(picture).width, 400);
  Landmark far;
  far.T_map_landmark = {9e5, -9e5, 0.0};
  graph_.add(far);
  far.T_map_landmark = {1e200, 0.0, 0.0};
  graph_.add(far);
  picture.grid = &room_;
  picture.graph = &graph_;
  EXPECT_GT(drawn(picture).width, 400);
}

TEST_F(MapPictures, OfHugeGridsStaySmall) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds({0, 0}, 1024);
  grid.set_log_odds({9000, 4000}, 1024);
  MapPicture picture;
  picture.grid = &grid;
  EXPECT_NEAR(drawn(picture).width, 1000, 60);
}

TEST_F(MapPictures, ThatCannotBeWrittenSayWhereAndWhy) {
  try {
    write_map_picture(file("nowhere/map.png"), {});
    FAIL() << "written into a folder that is not there";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("nowhere/map.png: cannot be written: "));
  }
}

bool overlap(const PixelBox& a, const PixelBox& b) {
  return a.min.x() < b.max.x() && b.min.x() < a.max.x() && a.min.y() < b.max.y() && b.min.y() < a.max.y();
}

TEST(LabelPlacer, KeepsLabelsOffLandmarksAndOffEachOther) {
  const PixelBox area{{0, 0}, {1000, 1000}};
  pictures::LabelPlacer placer(area, [](const PixelBox&) { return 0.0; });
  std::vector<PixelBox> taken;
  std::vector<Pixel> centres;
  for (int i = 0; i < 36; ++i) centres.emplace_back(20 + 190 * (i % 6), 20 + 190 * (i / 6));
  for (const Pixel& centre : centres) placer.avoid({centre - Pixel(20, 20), centre + Pixel(20, 20)}, 6.0);
  // A landmark is round: a label may touch the corners of its box.
  for (const Pixel& centre : centres) taken.push_back({centre - Pixel(14, 14), centre + Pixel(14, 14)});
  for (const Pixel& centre : centres) {
    const PixelBox label = placer.place(centre, 20.0, {110, 18}).value();
    for (const PixelBox& other : taken) EXPECT_FALSE(overlap(label, other)) << centre.transpose();
    EXPECT_TRUE(label.min.x() >= 0 && label.min.y() >= 0 && label.max.x() <= 1000 && label.max.y() <= 1000);
    taken.push_back(label);
  }
}

TEST(LabelPlacer, WouldRatherCoverTheEmptyBackground) {
  const PixelBox area{{0, 0}, {400, 400}};
  pictures::LabelPlacer placer(area, [](const PixelBox& box) { return box.centre().x() > 200 ? 1.0 : 0.0; });
  EXPECT_LT(placer.place({200, 200}, 10.0, {80, 18}).value().max.x(), 200);
}

TEST(LabelPlacer, LeavesOutALabelThatWouldOverlapAnotherOrWhatIsKeptClear) {
  const PixelBox area{{0, 0}, {400, 400}};
  pictures::LabelPlacer placer(area, [](const PixelBox&) { return 0.0; });
  placer.keep_line_clear(std::array{Pixel(100, 0), Pixel(100, 400)});
  std::vector<PixelBox> labels;
  int left_out = 0;
  for (int i = 0; i < 60; ++i) {
    const auto label = placer.place({200, 200}, 5.0, {60, 18});
    left_out += label ? 0 : 1;
    if (label) labels.push_back(*label);
  }
  EXPECT_GT(labels.size(), 4U);
  EXPECT_GT(left_out, 20) << "there is not that much room about one point";
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(overlap(labels[i], labels[k]));
  for (const PixelBox& label : labels) EXPECT_TRUE(label.max.x() < 100 || label.min.x() > 100);
  EXPECT_FALSE(placer.place({200, 200}, 5.0, {900, 18})) << "wider than the picture";
}

TEST_F(MapPictures, OfTheCoarseGridShowItsGreysAndItsTrigger) {
  CoarseGrid coarse(5, 2.0);
  coarse.rebuild(room_);
  CoarsePicture picture{&coarse, &room_, {}, {}, "OG2"};
  write_coarse_picture(file(), picture);
  const Png png = read_png(file());
  EXPECT_NEAR(png.width, 960, 60);
  EXPECT_GT(png.count(pictures::colour_of_ol(coarse.ol({5, 5}))), 100'000);
  picture.trigger_ol = 127.0;
  picture.region = {{3, 3}, {4, 3}};
  write_coarse_picture(file("trigger.png"), picture);
  EXPECT_GT(read_png(file("trigger.png")).height, png.height);
  EXPECT_THROW(write_coarse_picture(file(), {}), std::invalid_argument);
}

TEST_F(MapPictures, OfTemplatesShowATileForEach) {
  const TemplateSet set = render_ideal_set(shapes(), radians(15.0), 0.05);
  write_template_sheet(file("a.png"), set, "templates");
  write_template_sheet(file("b.png"), set, "templates");
  EXPECT_EQ(bytes_of(file("a.png")), bytes_of(file("b.png")));
  const Png png = read_png(file("a.png"));
  EXPECT_NEAR(png.width, 1000, 60);
  // Seven dark tiles: one circle, six squares, each mostly ground.
  EXPECT_GT(png.count({24, 28, 34}), 7 * 108 * 108 / 2);
  EXPECT_LT(png.count({24, 28, 34}), 7 * 108 * 108);
  write_template_sheet(file("none.png"), {}, "no templates");
}

TEST(MapPictureFile, IsNotDrawnOverWhatIsNoPicture) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "map_picture_test_notes.txt";
  std::ofstream(file) << "notes";
  EXPECT_THROW(write_map_picture(file, {}), std::runtime_error);
  std::string text;
  std::ifstream(file) >> text;
  EXPECT_EQ(text, "notes");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace cairn
