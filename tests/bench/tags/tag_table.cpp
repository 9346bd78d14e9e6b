// Tags in pictures of random homes: which are found, how exact their poses are, beside libapriltag's own, and what a
// picture costs.
//     tag_table [HOMES [PICTURES_OF_EACH_TAG_AND_METRE [PICTURE]]]
// Homes are those of config/experiments/tags.yaml. Pictures are the simulator's, of the robot file's camera; some
// of the first home are written to PICTURE_*.png.

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/experiments/homes/tag_sight.hpp"
#include "framework/experiments/statistics.hpp"
#include "framework/files/robot_file.hpp"
#include "plugins/april_tags/marker_pose.hpp"
#include "plugins/april_tags/tag_finder.hpp"
#include "plugins/simulated_robot/camera/cameras.hpp"
#include "tests/bench/tags/raw_pose.hpp"
#include "tests/bench/tags/samples.hpp"
#include "tests/bench/tags/tag_home.hpp"

namespace cairn {
namespace {

constexpr std::uint64_t kFirstHome = 1001;
constexpr SightLimits kLimits{4.0, radians(60.0)};
constexpr int kWorseEvery = 3;  // picture is taken again in the worse camera
constexpr double kSamePlace_px = 3.0;

double thread_time_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

struct Figures {
  std::vector<TagSample> samples;
  std::vector<double> find_ms;  // corners of all tags of a picture
  std::vector<double> pose_ms;  // their poses
  std::int64_t pictures = 0;
  std::int64_t detections = 0;
  std::int64_t unknown = 0;    // of numbers that hang nowhere
  std::int64_t misplaced = 0;  // of a tag that is elsewhere in the picture, or not in it
};

class Booth {
 public:
  Booth(const RobotModel& robot, double decimate) : robot_(robot), config_(config_with(decimate)), finder_(config_) {}

  void take(int home, const World& world, const TagSight& sight, const Pose2& T_map_robot, const CameraImage& image,
            Figures& figures) {
    const double begin_ms = thread_time_ms();
    const std::vector<april_tags::FoundTag> found = finder_.find_in(image);
    const double found_ms = thread_time_ms();
    for (const april_tags::FoundTag& tag : found) (void)poses_of(tag, {});
    figures.find_ms.push_back(found_ms - begin_ms);
    figures.pose_ms.push_back(thread_time_ms() - found_ms);
    ++figures.pictures;
    for (const april_tags::FoundTag& tag : found) judge(world, T_map_robot, tag, figures);
    for (const WorldTag& tag : world.tags) {
      const auto sighted = sight.of(tag, camera(), T_map_robot, kLimits);
      if (!sighted) continue;
      const auto seen = std::ranges::find(found, tag.marker, &april_tags::FoundTag::marker);
      TagSample sample;
      sample.home = home;
      sample.distance_m = sighted->distance_m;
      sample.slant_rad = sighted->slant_rad;
      if (seen != found.end()) measure(inverse(T_map_robot) * tag.T_map_tag, tag.size_m, *seen, sample);
      figures.samples.push_back(sample);
    }
  }

 private:
  static april_tags::Config config_with(double decimate) {
    april_tags::Config config;
    config.decimate = decimate;
    return config;
  }
  [[nodiscard]] const CameraModel& camera() const { return robot_.cameras.front(); }
  [[nodiscard]] std::optional<april_tags::MarkerPoses> poses_of(const april_tags::FoundTag& tag,
                                                                const april_tags::PoseErrors& errors) const {
    return april_tags::pose_of_square(camera(), config_.size_m, tag.corners, errors);
  }

  void judge(const World& world, const Pose2& T_map_robot, const april_tags::FoundTag& found, Figures& figures) const {
    ++figures.detections;
    const auto tag = std::ranges::find(world.tags, found.marker, &WorldTag::marker);
    if (tag == world.tags.end()) {
      ++figures.unknown;
      return;
    }
    if (off_px(inverse(T_map_robot) * tag->T_map_tag, *tag, found) > kSamePlace_px) ++figures.misplaced;
  }

  // How far the middle of the corners is from where the truth has it.
  [[nodiscard]] double off_px(const Pose2& T_robot_tag, const WorldTag& tag, const april_tags::FoundTag& found) const {
    constexpr double kAcross[] = {-0.5, 0.5, 0.5, -0.5};
    constexpr double kUp[] = {-0.5, -0.5, 0.5, 0.5};
    Pixel off(0.0, 0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      const Point p = T_robot_tag * Point(0.0, tag.size_m * kAcross[i]);
      const auto pixel = pixel_of(camera(), {p.x(), p.y(), tag.height_m + tag.size_m * kUp[i]});
      if (!pixel) return std::numeric_limits<double>::infinity();
      off += 0.25 * (*pixel - found.corners[i]);
    }
    return off.norm();
  }

  void measure(const Pose2& truth, double size_m, const april_tags::FoundTag& seen, TagSample& sample) const {
    const auto poses = poses_of(seen, {});
    if (!poses) return;
    const Point eye_m = camera().T_robot_camera.position();
    const auto better = [&](const april_tags::MarkerPoses& two) -> const MarkerPose& {
      const auto off_rad = [&](const MarkerPose& pose) {
        return std::abs(wrap_angle(pose.T_robot_marker.theta_rad - truth.theta_rad));
      };
      return two.mirrored && off_rad(*two.mirrored) < off_rad(two.best) ? *two.mirrored : two.best;
    };
    sample.is_found = true;
    sample.keeps_two = poses->mirrored.has_value();
    sample.ours = error_of(poses->best.T_robot_marker, truth, eye_m);
    sample.ours_kept = error_of(better(*poses).T_robot_marker, truth, eye_m);
    sample.raw = error_of(raw_pose_of(camera(), size_m, seen.corners).T_robot_marker, truth, eye_m);
    sample.with_floor = normalized(better(*poses), truth, eye_m);
    if (const auto bare = poses_of(seen, {config_.corner_noise_px, 0.0, 0.0}))
      sample.of_corners = normalized(better(*bare), truth, eye_m);
  }

  RobotModel robot_;
  april_tags::Config config_;
  april_tags::TagFinder finder_;
};

void write_picture(const std::string& file, const CameraImage& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width_px);
  png.height = static_cast<png_uint_32>(image.height_px);
  png.format = PNG_FORMAT_GRAY;
  if (png_image_write_to_file(&png, file.c_str(), 0, image.grey->data(), 0, nullptr) == 0)
    throw std::runtime_error(file + ": cannot write it");
}

std::string cost_line(const std::string& name, const std::vector<double>& ms) {
  std::vector<double> sorted = ms;
  std::ranges::sort(sorted);
  const auto at = [&](double share) {
    return sorted.at(static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1)));
  };
  return fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", name, sorted.size(), at(0.5), at(0.99), sorted.back());
}

std::string tables_of(const std::string& name, const Figures& figures) {
  return fmt::format(
      "## {}\n\n{} pictures, {} detections: {} of numbers that hang nowhere, {} in another place\n\n{}\n{}\n{}\n{}\n",
      name, figures.pictures, figures.detections, figures.unknown, figures.misplaced, found_table(figures.samples),
      errors_table(figures.samples), sides_table(figures.samples), coverage_table(figures.samples));
}

void print(const Figures& full, const Figures& half, const Figures& worse) {
  std::cout << tables_of("As the robot file has it", full) << tables_of("decimate: 2", half)
            << tables_of("Worse pictures", worse)
            << "| CPU ms of a picture | pictures | median | 99 % | longest |\n|---|---:|---:|---:|---:|\n"
            << cost_line("corners", full.find_ms) << cost_line("poses of all its tags", full.pose_ms)
            << cost_line("corners, decimate: 2", half.find_ms);
}

// Out of focus, dim and grainy.
RobotModel with_worse_camera(RobotModel robot) {
  CameraModel& camera = robot.cameras.front();
  camera.blur_px = 1.5;
  camera.noise_ratio = 0.04;
  camera.exposure_ratio = 0.4;
  return robot;
}

CameraImage picture_of(Cameras& cameras, const Pose2& T_map_robot) {
  std::vector<CameraImage> images;
  cameras.take(T_map_robot, 0.0, 1.0, images);
  return images.at(0);
}

void run(int homes, int per_ring, const std::string& picture) {
  const RobotModel robot = load_robot(std::string(CAIRN_SOURCE_DIR) + "/config/robots/pioneer3dx_camera.yaml");
  const PhotoPlan plan{10, per_ring};
  const RobotModel worse_robot = with_worse_camera(robot);
  Booth booth(robot, 1.0);
  Booth half_booth(robot, 2.0);
  Figures full;
  Figures half;
  Figures worse;
  std::int64_t tags = 0;
  for (int home = 0; home < homes; ++home) {
    const std::uint64_t seed = kFirstHome + static_cast<std::uint64_t>(home);
    const TaggedHome tagged = tagged_home(plan, seed);
    const World& world = tagged.world;
    tags += static_cast<std::int64_t>(world.tags.size());
    const Scene scene(world);
    const TagSight sight(world);
    Cameras cameras(robot, world, scene, seed);
    Cameras worse_cameras(worse_robot, world, scene, seed);
    for (const Pose2& T_map_robot : photo_places(plan, tagged, robot.cameras.front(), seed)) {
      const CameraImage image = picture_of(cameras, T_map_robot);
      booth.take(home, world, sight, T_map_robot, image, full);
      half_booth.take(home, world, sight, T_map_robot, image, half);
      if (full.pictures % kWorseEvery != 0) continue;
      const CameraImage worse_image = picture_of(worse_cameras, T_map_robot);
      booth.take(home, world, sight, T_map_robot, worse_image, worse);
      if (!picture.empty() && home == 0) {
        write_picture(picture + "_" + std::to_string(full.pictures) + ".png", image);
        write_picture(picture + "_" + std::to_string(full.pictures) + "_worse.png", worse_image);
      }
    }
    std::cerr << "home " << seed << ": " << full.pictures << " pictures\n";
  }
  std::cout << homes << " homes, " << tags << " tags\n\n";
  print(full, half, worse);
}

}  // namespace
}  // namespace cairn

int main(int argc, char** argv) {
  try {
    cairn::run(argc > 1 ? std::atoi(argv[1]) : 60, argc > 2 ? std::atoi(argv[2]) : 3, argc > 3 ? argv[3] : "");
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "tag_table: " << error.what() << "\n";
    return 1;
  }
}
