#include "plugins/april_tags/april_tags.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "plugins/simulated_robot/camera/cameras.hpp"
#include "tests/plugins/simulated_robot/test_worlds.hpp"

namespace cairn::april_tags {
namespace {

// Pictures of a room of 8 x 8 m with one tag on its right wall.
class Studio {
 public:
  explicit Studio(MarkerId marker = {MarkerFamily::tag36h11, 7}, double size_m = 0.16) {
    world_.tags = {{marker, {8.0, 4.0, radians(180.0)}, 0.4, size_m}};
  }
  void remove_tag() { world_.tags.clear(); }

  // From distance_m, where the tag is seen slanting by slant_deg, off the picture's middle by aside_deg.
  [[nodiscard]] Pose2 stand(double distance_m, double slant_deg, double aside_deg) const {
    const double bearing = radians(180.0 + slant_deg);
    return {8.0 + distance_m * std::cos(bearing), 4.0 + distance_m * std::sin(bearing), radians(slant_deg + aside_deg)};
  }
  [[nodiscard]] CameraImage picture_from(const Pose2& T_map_robot, std::uint64_t seed = 1) const {
    RobotModel robot;
    robot.cameras = {camera};
    const Scene scene(world_);
    Cameras cameras(robot, world_, scene, seed);
    std::vector<CameraImage> images;
    cameras.take(T_map_robot, 0.0, 1.0, images);
    return images.at(0);
  }
  [[nodiscard]] Eigen::Vector3d error_of(const MarkerPose& pose, const Pose2& T_map_robot) const {
    const Pose2 truth = inverse(T_map_robot) * world_.tags[0].T_map_tag;
    return {pose.T_robot_marker.x_m - truth.x_m, pose.T_robot_marker.y_m - truth.y_m,
            wrap_angle(pose.T_robot_marker.theta_rad - truth.theta_rad)};
  }

  CameraModel camera;

 private:
  World world_ = testing::room(8.0, 8.0);
};

std::vector<MarkerSighting> seen_in(const CameraImage& image, const CameraModel& camera, const Config& config = {}) {
  AprilTags detector(config, {camera});
  return detector.detect({&image, 1}, Budget{});
}

double nees_of(const MarkerPose& pose, const Eigen::Vector3d& error) {
  return error.dot(pose.covariance.ldlt().solve(error));
}

struct Errors {
  std::vector<double> position_m, angle_deg, nees;
  int ambiguous = 0;
};

// Both poses count where both are left.
void add_errors(const Studio& studio, const MarkerSighting& sighting, const Pose2& T_map_robot, Errors& errors) {
  Eigen::Vector3d error = studio.error_of(sighting.pose, T_map_robot);
  double nees = nees_of(sighting.pose, error);
  if (sighting.mirrored) {
    ++errors.ambiguous;
    const Eigen::Vector3d other = studio.error_of(*sighting.mirrored, T_map_robot);
    if (const double other_nees = nees_of(*sighting.mirrored, other); other_nees < nees) {
      error = other;
      nees = other_nees;
    }
  }
  errors.position_m.push_back(error.head<2>().norm());
  errors.angle_deg.push_back(degrees(std::abs(error[2])));
  errors.nees.push_back(nees);
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.at(values.size() / 2);
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(AprilTags, FindsTagsFromHalfAMetreToThreeWithErrorsThatItsCovariancesCover) {
  const Studio studio;
  Errors all;
  for (const double distance_m : {0.5, 1.0, 2.0, 3.0}) {
    Errors errors;
    std::uint64_t seed = 1;
    for (const double slant_deg : {-50.0, -5.0, 12.0, 35.0})
      for (const double aside_deg : {-15.0, 8.0}) {
        const Pose2 T_map_robot = studio.stand(distance_m, slant_deg, aside_deg);
        const std::vector<MarkerSighting> seen = seen_in(studio.picture_from(T_map_robot, ++seed), studio.camera);
        ASSERT_EQ(seen.size(), 1U) << distance_m << " " << slant_deg << " " << aside_deg;
        EXPECT_EQ(seen[0].marker, (MarkerId{MarkerFamily::tag36h11, 7}));
        EXPECT_NEAR(seen[0].pose.height_m, 0.4, 0.03);
        add_errors(studio, seen[0], T_map_robot, errors);
        add_errors(studio, seen[0], T_map_robot, all);
      }
    if (std::getenv("CAIRN_TEST_FIGURES") != nullptr)
      std::cout << distance_m << " m: " << median(errors.position_m) << " m, " << median(errors.angle_deg)
                << " deg, NEES " << mean(errors.nees) << ", both poses kept " << errors.ambiguous << "\n";
    EXPECT_LT(median(errors.position_m), 0.05) << distance_m;
    EXPECT_LT(median(errors.angle_deg), 3.0) << distance_m;
  }
  EXPECT_LT(mean(all.nees), 3.0 * 1.5) << "errors are larger than they say";
  EXPECT_GT(mean(all.nees), 0.1) << "errors are far smaller than they say";
  EXPECT_LT(*std::ranges::max_element(all.nees), 25.0);
}

TEST(AprilTags, FindsEachFamilyThatIsAskedForAndNoOther) {
  for (const MarkerId& marker : {MarkerId{MarkerFamily::tag36h11, 586}, MarkerId{MarkerFamily::tag25h9, 34},
                                 MarkerId{MarkerFamily::tagStandard41h12, 2114}}) {
    const Studio studio(marker);
    const Pose2 T_map_robot = studio.stand(1.5, 20.0, 0.0);
    const CameraImage image = studio.picture_from(T_map_robot);
    Config config;
    config.families.assign(std::begin(kMarkerFamilies), std::end(kMarkerFamilies));
    const std::vector<MarkerSighting> seen = seen_in(image, studio.camera, config);
    ASSERT_EQ(seen.size(), 1U) << name_of(marker.family);
    EXPECT_EQ(seen[0].marker, marker);
    EXPECT_LT(studio.error_of(seen[0].pose, T_map_robot).head<2>().norm(), 0.03);
    std::erase(config.families, marker.family);
    EXPECT_TRUE(seen_in(image, studio.camera, config).empty()) << name_of(marker.family);
  }
}

TEST(AprilTags, FindsNothingInPicturesWithoutTags) {
  Studio studio;
  studio.remove_tag();
  studio.camera.noise_ratio = 0.1;
  Config config;
  config.families.assign(std::begin(kMarkerFamilies), std::end(kMarkerFamilies));
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    EXPECT_TRUE(
        seen_in(studio.picture_from({2.0, 2.0, radians(70.0 * static_cast<double>(seed))}, seed), studio.camera, config)
            .empty());
}

TEST(AprilTags, TakesTheSizeOfTheirIds) {
  const Studio studio({MarkerFamily::tag36h11, 7}, 0.08);
  const Pose2 T_map_robot = studio.stand(1.0, 10.0, 0.0);
  Config config;
  config.sizes = {{MarkerFamily::tag36h11, 5, 9, 0.08}};
  const auto seen = seen_in(studio.picture_from(T_map_robot), studio.camera, config);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_LT(studio.error_of(seen[0].pose, T_map_robot).head<2>().norm(), 0.03);
  EXPECT_EQ(size_of(config, {MarkerFamily::tag36h11, 4}), 0.16);
  EXPECT_EQ(size_of(config, {MarkerFamily::tag25h9, 7}), 0.16) << "another family";
}

TEST(AprilTags, IgnoresPicturesThatTheRobotFileDoesNotHave) {
  const Studio studio;
  CameraImage image = studio.picture_from(studio.stand(1.0, 0.0, 0.0));
  AprilTags detector({}, {studio.camera});
  image.camera = 1;
  EXPECT_TRUE(detector.detect({&image, 1}, Budget{}).empty());
  image.camera = 0;
  image.width_px = 320;
  EXPECT_TRUE(detector.detect({&image, 1}, Budget{}).empty());
}

std::string error_of(const std::string& settings) {
  try {
    const AprilTags detector(load_config<Config>(parse_config_text(settings, "m.yaml"), "april_tags"), {});
  } catch (const ConfigError& error) {
    return error.place().file.empty() ? error.sentence() : error.what();
  }
  return "none";
}

TEST(AprilTags, AnUnknownFamilyNamesTheNearestAtItsPlace) {
  EXPECT_EQ(error_of("families: [25h9, 36h12]"),
            "m.yaml:1:18: families must be one of 36h11, 25h9, standard41h12, found \"36h12\" (did you mean "
            "\"36h11\"?)");
  EXPECT_EQ(error_of("families: []"), "m.yaml:1:11: families must name at least one of 36h11, 25h9, standard41h12");
}

TEST(AprilTags, SizesAreOfTagsThatThereAre) {
  EXPECT_EQ(error_of("sizes: [{first: 5, last: 586, size_m: 0.1}]"), "none");
  EXPECT_EQ(error_of("sizes: [{first: 5, last: 587, size_m: 0.1}]"),
            "sizes: 5 to 587: there are no such tags: 36h11 has 0 to 586");
  EXPECT_EQ(error_of("sizes: [{family: 25h9, first: 9, last: 5, size_m: 0.1}]"), "sizes: 9 to 5: last is below first");
}

}  // namespace
}  // namespace cairn::april_tags
