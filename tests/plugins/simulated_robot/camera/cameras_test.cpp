#include "plugins/simulated_robot/camera/cameras.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagStandard41h12.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "plugins/simulated_robot/simulated_robot.hpp"
#include "tests/plugins/simulated_robot/test_worlds.hpp"

namespace cairn {
namespace {

struct Found {
  MarkerId marker;
  std::vector<Pixel> corners;  // lower left, then anticlockwise, of who looks at it
};

// By libapriltag, which counts pixels from their corners.
std::vector<Found> found_in(const CameraImage& image, MarkerFamily family) {
  apriltag_family_t* codes = family == MarkerFamily::tag36h11  ? tag36h11_create()
                             : family == MarkerFamily::tag25h9 ? tag25h9_create()
                                                               : tagStandard41h12_create();
  apriltag_detector_t* detector = apriltag_detector_create();
  apriltag_detector_add_family(detector, codes);
  detector->quad_decimate = 1.0F;
  std::vector<std::uint8_t> grey = *image.grey;
  image_u8_t view = {image.width_px, image.height_px, image.width_px, grey.data()};
  zarray_t* detections = apriltag_detector_detect(detector, &view);
  std::vector<Found> found;
  for (int i = 0; i < zarray_size(detections); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(detections, i, &detection);
    Found& tag = found.emplace_back(Found{{family, detection->id}, {}});
    for (const auto& corner : detection->p) tag.corners.emplace_back(corner[0] - 0.5, corner[1] - 0.5);
  }
  apriltag_detections_destroy(detections);
  apriltag_detector_destroy(detector);
  if (family == MarkerFamily::tag36h11) tag36h11_destroy(codes);
  if (family == MarkerFamily::tag25h9) tag25h9_destroy(codes);
  if (family == MarkerFamily::tagStandard41h12) tagStandard41h12_destroy(codes);
  return found;
}

// Where the corners of the tag truly are in the picture.
std::vector<Pixel> corners_of(const WorldTag& tag, const CameraModel& camera, const Pose2& T_map_robot) {
  const Pose2 T_robot_tag = inverse(T_map_robot) * tag.T_map_tag;
  const double half_m = 0.5 * tag.size_m;
  std::vector<Pixel> corners;
  for (const auto& [right, up] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Point p = T_robot_tag * Point(0.0, right * half_m);
    corners.push_back(pixel_of(camera, {p.x(), p.y(), tag.height_m + up * half_m}).value());
  }
  return corners;
}

WorldTag tag_at(MarkerId marker, const Pose2& T_map_tag, double size_m = 0.16) {
  return {marker, T_map_tag, 0.3, size_m};
}

// A tag of each family on the far wall of a room of 4 x 4 m; the robot stands in its middle and looks there.
World marked_room() {
  World world = testing::room(4.0, 4.0);
  world.tags = {tag_at({MarkerFamily::tag36h11, 7}, {4.0, 1.5, radians(180.0)}),
                tag_at({MarkerFamily::tag25h9, 3}, {4.0, 2.0, radians(180.0)}),
                tag_at({MarkerFamily::tagStandard41h12, 1000}, {4.0, 2.5, radians(180.0)})};
  return world;
}

CameraImage picture_of(const World& world, const CameraModel& camera, const Pose2& T_map_robot) {
  RobotModel robot;
  robot.cameras = {camera};
  const Scene scene(world);
  Cameras cameras(robot, world, scene, 1);
  std::vector<CameraImage> images;
  cameras.take(T_map_robot, 0.0, 1.0, images);
  return images.at(0);
}

// To be looked at, where CAIRN_TEST_PICTURES names a folder.
void show(const CameraImage& image, const std::string& name) {
  const char* folder = std::getenv("CAIRN_TEST_PICTURES");
  if (folder == nullptr) return;
  std::ofstream out(std::string(folder) + "/" + name + ".pgm", std::ios::binary);
  out << "P5\n" << image.width_px << " " << image.height_px << "\n255\n";
  out.write(reinterpret_cast<const char*>(image.grey->data()), static_cast<std::streamsize>(image.grey->size()));
}

double largest_error_px(const World& world, const CameraModel& camera, const Pose2& T_map_robot,
                        const std::string& name) {
  const CameraImage image = picture_of(world, camera, T_map_robot);
  show(image, name);
  double largest_px = 0.0;
  for (const WorldTag& tag : world.tags) {
    const std::vector<Pixel> truth = corners_of(tag, camera, T_map_robot);
    const std::vector<Found> found = found_in(image, tag.marker.family);
    EXPECT_EQ(found.size(), 1U) << name << ": " << name_of(tag.marker.family);
    if (found.size() != 1) return 1e9;
    EXPECT_EQ(found[0].marker, tag.marker);
    for (std::size_t i = 0; i < 4; ++i) largest_px = std::max(largest_px, (found[0].corners[i] - truth[i]).norm());
  }
  return largest_px;
}

TEST(SimulatedCamera, ShowsTagsOfEachFamilyWhereTheyAre) {
  EXPECT_LT(largest_error_px(marked_room(), CameraModel{}, {2.0, 2.0, 0.0}, "ahead"), 0.5);
  EXPECT_LT(largest_error_px(marked_room(), CameraModel{}, {2.3, 1.2, radians(25.0)}, "slanting"), 0.5);
}

TEST(SimulatedCamera, ShowsThemThroughALensThatLooksUpFromASideAndDistorts) {
  CameraModel camera;
  camera.T_robot_camera = {0.1, -0.2, radians(8.0)};
  camera.height_m = 0.1;
  camera.tilt_rad = radians(12.0);
  camera.focal_x_px = 500.0;
  camera.focal_y_px = 510.0;
  camera.centre_x_px = 330.0;
  camera.centre_y_px = 220.0;
  camera.distortion = {-0.25, 0.08, 0.001, -0.002, 0.0};
  EXPECT_LT(largest_error_px(marked_room(), camera, {2.0, 2.0, 0.0}, "distorted"), 0.5);
}

TEST(SimulatedCamera, UndoesTheDistortionOfItsLens) {
  CameraModel camera;
  camera.tilt_rad = radians(-20.0);
  camera.T_robot_camera = {0.1, 0.05, radians(30.0)};
  camera.distortion = {-0.25, 0.08, 0.001, -0.002, 0.0};
  for (const Pixel& pixel : {Pixel{0, 0}, Pixel{639, 0}, Pixel{100, 400}, Pixel{320, 240}, Pixel{639, 479}}) {
    const Eigen::Vector3d d = direction_of(camera, undistorted(camera, pixel));
    const Point p = camera.T_robot_camera * Point(2.0 * d.x(), 2.0 * d.y());
    EXPECT_LT((pixel_of(camera, {p.x(), p.y(), camera.height_m + 2.0 * d.z()}).value() - pixel).norm(), 1e-4);
  }
  EXPECT_FALSE(pixel_of(camera, {-5.0, -5.0, 0.3})) << "behind it";
}

TEST(SimulatedCamera, SeesNoTagFromBehindNorBehindAnything) {
  World world = marked_room();
  world.tags = {tag_at({MarkerFamily::tag36h11, 7}, {4.0, 2.0, radians(180.0)})};
  const auto count = [&](const Pose2& T_map_robot) {
    return found_in(picture_of(world, {}, T_map_robot), MarkerFamily::tag36h11).size();
  };
  EXPECT_EQ(count({2.0, 2.0, 0.0}), 1U);
  EXPECT_EQ(count({2.0, 2.0, radians(180.0)}), 0U) << "it looks away";
  world.tags[0].T_map_tag = {3.0, 2.0, 0.0};
  EXPECT_EQ(count({2.0, 2.0, 0.0}), 0U) << "it faces the wall";
  world.tags[0].T_map_tag = {4.0, 2.0, radians(180.0)};
  world.objects = {testing::circle_at({3.0, 2.0}, 0.3)};
  EXPECT_EQ(count({2.0, 2.0, 0.0}), 0U) << "a pillar hides it";
  world.objects = {testing::circle_at({3.0, 2.15}, 0.3)};
  EXPECT_EQ(count({2.0, 2.0, 0.0}), 0U) << "half of it";
  world.objects = {testing::circle_at({3.0, 2.5}, 0.3)};
  EXPECT_EQ(count({2.0, 2.0, 0.0}), 1U) << "it stands aside";
}

TEST(SimulatedCamera, BlurExposureAndNoiseAreThoseOfItsFile) {
  World world = testing::room(4.0, 4.0);
  CameraModel camera;
  const auto spread = [&] {
    const CameraImage image = picture_of(world, camera, {2.0, 2.0, 0.0});
    double sum = 0.0;
    double squares = 0.0;
    for (int x = 300; x < 340; ++x)
      for (int y = 235; y < 245; ++y) {
        const double grey = (*image.grey)[static_cast<std::size_t>(y * image.width_px + x)];
        sum += grey;
        squares += grey * grey;
      }
    return std::pair{sum / 400.0, std::sqrt(std::max(0.0, squares / 400.0 - sum * sum / 160000.0))};
  };
  camera.noise_ratio = 0.0;
  const double grey = spread().first;
  EXPECT_LT(spread().second, 0.5) << "of one wall";
  camera.noise_ratio = 0.02;
  EXPECT_NEAR(spread().second, 0.02 * 255.0, 0.8);
  camera.noise_ratio = 0.0;
  camera.exposure_ratio *= 0.5;
  EXPECT_NEAR(spread().first, 0.5 * grey, 1.0);
  camera.exposure_ratio = 10.0;
  EXPECT_EQ(spread().first, 255.0) << "overexposed";

  camera = {};
  camera.noise_ratio = 0.0;
  world.tags = {tag_at({MarkerFamily::tag36h11, 7}, {4.0, 2.0, radians(180.0)})};
  const auto darkest = [&] { return *std::ranges::min_element(*picture_of(world, camera, {2.0, 2.0, 0.0}).grey); };
  EXPECT_LT(darkest(), 30);
  camera.blur_px = 8.0;
  EXPECT_GT(darkest(), 60) << "black cells of 5 pixels run into the white ones";
}

TEST(SimulatedCamera, TakesPicturesAtItsRateAndOnlyWhenTheyAreWanted) {
  const World world = marked_room();
  RobotModel robot = testing::exact_robot();
  CameraModel camera;
  camera.width_px = 64;
  camera.height_px = 48;
  camera.rate_hz = 5.0;
  robot.cameras = {camera};
  SimulatedRobot blind({}, robot, &world, {2.0, 2.0, 0.0}, 1);
  SimulatedRobot seeing({}, robot, &world, {2.0, 2.0, 0.0}, 1, 0.0, true);
  SimulatedRobot again({}, robot, &world, {2.0, 2.0, 0.0}, 1, 0.0, true);
  int pictures = 0;
  for (int tick = 0; tick < 50; ++tick) {
    const Observation none = blind.next({}).observation;
    const Observation some = seeing.next({}).observation;
    const Observation same = again.next({}).observation;
    EXPECT_TRUE(none.images.empty());
    ASSERT_EQ(some.images.size(), same.images.size());
    for (std::size_t i = 0; i < some.images.size(); ++i) {
      EXPECT_EQ(some.images[i].stamp_s, some.stamp_s);
      EXPECT_EQ(some.images[i].grey->size(), 64U * 48U);
      EXPECT_EQ(*some.images[i].grey, *same.images[i].grey);
    }
    pictures += static_cast<int>(some.images.size());
    ASSERT_EQ(none.ranges.size(), some.ranges.size());
    for (std::size_t i = 0; i < none.ranges.size(); ++i) EXPECT_EQ(none.ranges[i].range_m, some.ranges[i].range_m);
    EXPECT_EQ(none.T_odom_robot, some.T_odom_robot);
  }
  EXPECT_EQ(pictures, 10) << "in 2 s";
}

TEST(SimulatedCamera, EachFamilyHasAsManyTagsAsWorldFilesMayName) {
  for (const auto& [family, last] :
       {std::pair{MarkerFamily::tag36h11, 586}, {MarkerFamily::tag25h9, 34}, {MarkerFamily::tagStandard41h12, 2114}}) {
    EXPECT_NO_THROW((void)pattern_of({family, last}));
    EXPECT_THROW((void)pattern_of({family, last + 1}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace cairn
