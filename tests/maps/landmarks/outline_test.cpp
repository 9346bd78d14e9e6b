#include "maps/landmarks/outline.hpp"

#include <gmock/gmock.h>
#include <png.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace cairn {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

double signed_area(const std::vector<Point>& p) {
  double twice = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point& a = p[i];
    const Point& b = p[(i + 1) % p.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return twice / 2.0;
}

TEST(WithArcs, MakesACircleOfTwoHalves) {
  const std::vector<Point> circle =
      with_arcs(std::vector<Point>{{0.3, 0.0}, {-0.3, 0.0}}, std::vector<double>{1.0, 1.0});
  for (const Point& p : circle) EXPECT_NEAR(p.norm(), 0.3, 1e-12);
  const double exact = std::numbers::pi * 0.09;
  EXPECT_NEAR(signed_area(circle), exact, 0.001 * 2.0 * std::numbers::pi * 0.3) << "within 1 mm all round";
}

TEST(WithArcs, BendsOutwardAboveZeroAndInwardBelow) {
  const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const double quarter = std::tan(std::numbers::pi / 8.0);  // a quarter of a circle
  // The segment between a quarter circle and its chord of length 1.
  const double segment = (std::numbers::pi / 2.0 - 1.0) / 4.0;
  EXPECT_NEAR(signed_area(with_arcs(square, std::vector<double>{quarter, 0, 0, 0})), 1.0 + segment, 0.0012);
  EXPECT_NEAR(signed_area(with_arcs(square, std::vector<double>{0, 0, -quarter, 0})), 1.0 - segment, 0.0012);
}

TEST(WithArcs, NeverTurnsSharply) {
  const std::vector<Point> small =
      with_arcs(std::vector<Point>{{0.01, 0.0}, {-0.01, 0.0}}, std::vector<double>{1.0, 1.0});
  EXPECT_EQ(small.size(), 24U) << "15 degrees a chord";
}

TEST(WithArcs, LeavesStraightSidesAlone) {
  const std::vector<Point> triangle{{0, 0}, {1, 0}, {0, 1}};
  EXPECT_EQ(with_arcs(triangle, std::vector<double>{0, 0, 0}), triangle);
  EXPECT_THROW((void)with_arcs(triangle, std::vector<double>{0, 0}), std::invalid_argument);
  EXPECT_THROW((void)with_arcs(triangle, std::vector<double>{0, 0, std::nan("")}), std::invalid_argument);
}

class PictureOutline : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cairn_outline_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // One pixel a character: '#' has the one grey value, all else the other.
  fs::path picture(const std::vector<std::string>& rows, std::uint8_t thing = 0, std::uint8_t ground = 255) const {
    std::string pixels;
    for (const std::string& row : rows)
      for (const char c : row) pixels.push_back(static_cast<char>(c == '#' ? thing : ground));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(rows.front().size());
    image.height = static_cast<png_uint_32>(rows.size());
    image.format = PNG_FORMAT_GRAY;
    const fs::path file = folder_ / "picture.png";
    EXPECT_NE(png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr), 0) << image.message;
    return file;
  }

  static std::string error_of(const fs::path& file) {
    try {
      (void)contour_in_picture(file, 0.1);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_;
};

TEST_F(PictureOutline, OfARectangleIsTheEdgeOfItsPixels) {
  const Contour contour = contour_in_picture(picture({"........",  //
                                                      "..####..",  //
                                                      "..####..",  //
                                                      "........"}),
                                             0.1);
  ASSERT_EQ(contour.polygons_m.size(), 1U);
  EXPECT_NEAR(signed_area(contour.polygons_m[0]), 0.4 * 0.2, 1e-9);
  EXPECT_NEAR(contour.outer_diameter_m(), std::hypot(0.4, 0.2), 1e-9);
}

TEST_F(PictureOutline, IsTheSameLightOnDarkAndAtTheRim) {
  const std::vector<std::string> rows{"#####...", "#####...", "##......", "........"};
  EXPECT_EQ(contour_in_picture(picture(rows), 0.1), contour_in_picture(picture(rows, 200, 30), 0.1));
}

TEST_F(PictureOutline, HasUpAsY) {
  const Contour contour = contour_in_picture(picture({"...............",  //
                                                      "......###......",  //
                                                      "......###......",  //
                                                      "......###......",  //
                                                      "..###########..",  //
                                                      "..###########..",  //
                                                      "..###########..",  //
                                                      "..............."}),
                                             0.1);
  EXPECT_LT(contour.signed_distance({0.0, 0.3}), 0.0) << "in the stem";
  EXPECT_GT(contour.signed_distance({0.4, 0.3}), 0.0) << "beside the stem";
  EXPECT_LT(contour.signed_distance({0.4, -0.1}), 0.0) << "in the bar below";
}

TEST_F(PictureOutline, OfSeveralPiecesHasAsManyPartsAndFillsHoles) {
  const Contour contour = contour_in_picture(picture({"............",  //
                                                      ".###....###.",  //
                                                      ".#.#....###.",  //
                                                      ".###....###.",  //
                                                      "............"}),
                                             0.1);
  ASSERT_EQ(contour.polygons_m.size(), 2U);
  EXPECT_NEAR(signed_area(contour.polygons_m[0]), 0.09, 1e-9);
  EXPECT_NEAR(signed_area(contour.polygons_m[1]), 0.09, 1e-9);
}

TEST_F(PictureOutline, JoinsPiecesThatTouchWithACorner) {
  const Contour contour = contour_in_picture(picture({"........",  //
                                                      ".###....",  //
                                                      ".###....",  //
                                                      ".###....",  //
                                                      "....###.",  //
                                                      "....###.",  //
                                                      "....###.",  //
                                                      "........"}),
                                             0.1);
  EXPECT_EQ(contour.polygons_m.size(), 1U);
}

TEST_F(PictureOutline, StaysNearTheEdgeOfARoundThing) {
  std::vector<std::string> rows(64, std::string(64, '.'));
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      if (std::hypot(x - 31.5, y - 31.5) <= 25.0) rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = '#';
  const Contour contour = contour_in_picture(picture(rows), 0.01);
  for (const Point& p : contour.polygons_m.front()) EXPECT_NEAR(p.norm(), 0.25, 0.0125);
  EXPECT_LT(contour.polygons_m.front().size(), 40U) << "smoothed";
}

TEST_F(PictureOutline, SaysWhatIsWrongWithAPicture) {
  EXPECT_THAT(error_of(folder_ / "gone.png"), HasSubstr("no such picture: "));
  std::ofstream(folder_ / "text.png") << "no picture";
  EXPECT_THAT(error_of(folder_ / "text.png"), HasSubstr("is not a PNG picture: "));
  EXPECT_THAT(error_of(picture({"....", "...."})), HasSubstr("is of one colour"));
  EXPECT_THAT(error_of(picture({"####", "####"})), HasSubstr("is of one colour"));
  EXPECT_THAT(error_of(picture({std::string(2000, '.')})), HasSubstr("2000 x 1 pixels, at most 1024 x 1024"));
  std::vector<std::string> dots(200, std::string(200, '.'));
  for (std::size_t y = 1; y < 199; y += 2)
    for (std::size_t x = 1; x < 199; x += 2) dots[y][x] = '#';
  EXPECT_THAT(error_of(picture(dots)), HasSubstr("too ragged"));
}

}  // namespace
}  // namespace cairn
