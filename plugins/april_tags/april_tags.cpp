#include "plugins/april_tags/april_tags.hpp"

#include <utility>

#include "plugins/april_tags/marker_pose.hpp"

namespace cairn::april_tags {
namespace {

bool is_of(const CameraImage& image, const std::vector<CameraModel>& cameras) {
  if (image.camera < 0 || static_cast<std::size_t>(image.camera) >= cameras.size() || !image.grey) return false;
  const CameraModel& camera = cameras[static_cast<std::size_t>(image.camera)];
  return image.width_px == camera.width_px && image.height_px == camera.height_px &&
         image.grey->size() == static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
}

}  // namespace

AprilTags::AprilTags(const Config& config, std::vector<CameraModel> cameras)
    : config_(config), cameras_(std::move(cameras)), finder_(config) {
  check_sizes(config);
}

std::vector<MarkerSighting> AprilTags::detect(std::span<const CameraImage> images, const Budget& budget) {
  std::vector<MarkerSighting> sightings;
  for (const CameraImage& image : images) {
    if (budget.exhausted()) break;
    if (is_of(image, cameras_)) add_sightings(image, sightings);
  }
  return sightings;
}

void AprilTags::add_sightings(const CameraImage& image, std::vector<MarkerSighting>& sightings) {
  const PoseErrors errors{config_.corner_noise_px, config_.min_position_error_m, config_.min_angle_error_rad};
  for (const FoundTag& tag : finder_.find_in(image)) {
    const auto poses = pose_of_square(cameras_[static_cast<std::size_t>(image.camera)], size_of(config_, tag.marker),
                                      tag.corners, errors);
    if (poses) sightings.push_back({tag.marker, image.camera, image.stamp_s, poses->best, poses->mirrored});
  }
}

}  // namespace cairn::april_tags
