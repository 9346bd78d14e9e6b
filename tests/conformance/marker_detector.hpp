// Conformance of modules of kind `marker_detector`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyFinder, MarkerDetectorConformance,
//                            testing::Values(module<cairn::MarkerDetector>(FOLDER, "my_finder", "{size_m: 0.16}")));
//   }
//
// The robot has one camera of 640 x 480 pixels. A picture shows one marker, number 0 of the family 36h11, 0.16 m large,
// straight ahead at the height of the lens; others show none. Settings must be such that it is looked for.
#pragma once

#include <Eigen/Cholesky>
#include <cstdint>
#include <memory>
#include <random>

#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

inline constexpr double kMarkerSize_m = 0.16;

class MarkerDetectorConformance : public testing::TestWithParam<Subject<MarkerDetector>> {
 protected:
  [[nodiscard]] static Subject<MarkerDetector> subject() {
    RobotModel robot = eight_sonar_robot();
    robot.cameras = {CameraModel{}};
    return GetParam().with_robot(robot);
  }
  [[nodiscard]] std::shared_ptr<MarkerDetector> make(std::uint64_t seed = 1) const { return subject().make(seed); }

  [[nodiscard]] static CameraImage picture_of(const std::vector<std::uint8_t>& grey, double stamp_s = 1.0) {
    const CameraModel camera;
    return {0, stamp_s, camera.width_px, camera.height_px, std::make_shared<std::vector<std::uint8_t>>(grey)};
  }
  [[nodiscard]] static std::vector<std::uint8_t> plain_grey(std::uint8_t value = 150) {
    const CameraModel camera;
    return std::vector<std::uint8_t>(
        static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px), value);
  }
  // The marker with its white margin; each cell is so many pixels.
  [[nodiscard]] static CameraImage picture_of_marker(int cell_px, double stamp_s = 1.0) {
    constexpr std::string_view kRows[] = {"..........", ".########.", ".#..#.#.#.", ".##...#.#.", ".##..####.",
                                          ".#.#.####.", ".##.#..##.", ".####.###.", ".########.", ".........."};
    const CameraModel camera;
    std::vector<std::uint8_t> grey = plain_grey();
    const int side = 10 * cell_px;
    const int left = (camera.width_px - side) / 2;
    const int top = (camera.height_px - side) / 2;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const bool is_black = kRows[y / cell_px][static_cast<std::size_t>(x / cell_px)] == '#';
        grey[static_cast<std::size_t>((top + y) * camera.width_px + left + x)] = is_black ? 15 : 240;
      }
    return picture_of(grey, stamp_s);
  }
  [[nodiscard]] static double distance_m(int cell_px) {
    return CameraModel{}.focal_x_px * kMarkerSize_m / (8.0 * cell_px);
  }
  [[nodiscard]] static std::vector<MarkerSighting> seen_in(MarkerDetector& detector, const CameraImage& image) {
    return detector.detect({&image, 1}, Budget{});
  }
  [[nodiscard]] static std::string text_of_all(const std::vector<MarkerSighting>& sightings) {
    std::string text;
    for (const MarkerSighting& seen : sightings)
      text += cairn::text_of(seen.marker) + " " + text_of(seen.pose.T_robot_marker) + " " +
              text_of(seen.pose.covariance.sum()) + (seen.mirrored ? " or mirrored\n" : "\n");
    return text;
  }
};

TEST_P(MarkerDetectorConformance, IsMadeTwiceAndDestroyedUnused) {
  EXPECT_NE(make(), make()) << "a factory makes a new object each time";
}

TEST_P(MarkerDetectorConformance, OutlivesTheLibraryThatMadeIt) {
  const auto detector = subject().make_outliving_library();
  EXPECT_EQ(seen_in(*detector, picture_of_marker(10)).size(), 1U);
}

TEST_P(MarkerDetectorConformance, FindsAMarkerWhereItHangs) {
  const auto detector = make();
  for (const int cell_px : {6, 10, 20}) {
    const std::vector<MarkerSighting> seen = seen_in(*detector, picture_of_marker(cell_px, 2.5));
    ASSERT_EQ(seen.size(), 1U) << cell_px << " pixels a cell";
    EXPECT_EQ(seen[0].marker, (MarkerId{MarkerFamily::tag36h11, 0}));
    EXPECT_EQ(seen[0].camera, 0);
    EXPECT_EQ(seen[0].stamp_s, 2.5);
    EXPECT_NEAR(seen[0].pose.T_robot_marker.x_m, distance_m(cell_px), 0.05 * distance_m(cell_px));
    EXPECT_NEAR(seen[0].pose.T_robot_marker.y_m, 0.0, 0.02);
    EXPECT_NEAR(seen[0].pose.height_m, CameraModel{}.height_m, 0.02);
    EXPECT_GT(std::abs(seen[0].pose.T_robot_marker.theta_rad), radians(150.0)) << "its printed side faces the robot";
    EXPECT_EQ(seen[0].pose.covariance.llt().info(), Eigen::Success) << "no covariance";
  }
}

TEST_P(MarkerDetectorConformance, FindsNothingWhereThereIsNone) {
  const auto detector = make();
  for (const int value : {0, 150, 255}) {
    const CameraImage plain = picture_of(plain_grey(static_cast<std::uint8_t>(value)));
    EXPECT_TRUE(seen_in(*detector, plain).empty()) << "grey of " << value;
  }
  std::mt19937 random(1);
  std::vector<std::uint8_t> noise = plain_grey();
  for (std::uint8_t& pixel : noise) pixel = static_cast<std::uint8_t>(random() % 256);
  EXPECT_TRUE(seen_in(*detector, picture_of(noise)).empty()) << "in noise";
  EXPECT_TRUE(detector->detect({}, Budget{}).empty()) << "without pictures";
}

TEST_P(MarkerDetectorConformance, AUsedUpBudgetBeginsNoPicture) {
  const auto detector = make();
  const CameraImage image = picture_of_marker(10);
  EXPECT_TRUE(detector->detect({&image, 1}, UsedUpBudget::past_deadline()).empty());
  EXPECT_EQ(seen_in(*detector, image).size(), 1U);
}

TEST_P(MarkerDetectorConformance, PicturesThatTheRobotFileDoesNotHaveAreIgnored) {
  const auto detector = make();
  CameraImage other = picture_of_marker(10);
  other.camera = 1;
  EXPECT_TRUE(seen_in(*detector, other).empty()) << "of a second camera";
  other.camera = -1;
  EXPECT_TRUE(seen_in(*detector, other).empty());
  CameraImage small = picture_of_marker(10);
  small.height_px /= 2;
  EXPECT_TRUE(seen_in(*detector, small).empty()) << "of another size";
  CameraImage empty = picture_of_marker(10);
  empty.grey = nullptr;
  EXPECT_TRUE(seen_in(*detector, empty).empty()) << "without pixels";
}

TEST_P(MarkerDetectorConformance, TheSamePicturesGiveTheSameSightings) {
  const auto first = make(7);
  const auto second = make(7);
  for (const int cell_px : {6, 10, 20})
    EXPECT_EQ(text_of_all(seen_in(*first, picture_of_marker(cell_px))),
              text_of_all(seen_in(*second, picture_of_marker(cell_px))));
}

TEST_P(MarkerDetectorConformance, EachPictureHasItsOwnSightings) {
  const auto detector = make();
  const std::vector<CameraImage> images{picture_of_marker(10, 1.0), picture_of(plain_grey(), 1.1),
                                        picture_of_marker(20, 1.2)};
  const std::vector<MarkerSighting> seen = detector->detect(images, Budget{});
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].stamp_s, 1.0);
  EXPECT_EQ(seen[1].stamp_s, 1.2);
}

}  // namespace cairn::conformance
