#include "plugins/simulated_robot/camera/cameras.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace cairn {
namespace {

constexpr std::uint64_t kCameraPurpose = 400;
constexpr double kRounding = 1e-6;  // of a period

double pictures_until(double time_s, double rate_hz) {
  return std::floor(time_s * rate_hz + kRounding);
}

cv::Mat blurred(const std::vector<float>& light, const CameraModel& model) {
  cv::Mat picture(model.height_px, model.width_px, CV_32F);
  std::ranges::copy(light, picture.ptr<float>());
  if (model.blur_px > 0.0) cv::GaussianBlur(picture, picture, {}, model.blur_px, model.blur_px, cv::BORDER_REPLICATE);
  return picture;
}

}  // namespace

Cameras::Cameras(const RobotModel& robot, const World& world, const Scene& scene, std::uint64_t seed)
    : tags_(world.tags) {
  cameras_.reserve(robot.cameras.size());
  for (std::size_t i = 0; i < robot.cameras.size(); ++i)
    cameras_.push_back(
        {robot.cameras[i], Picture(robot.cameras[i], scene, tags_), NoiseStream(seed, kCameraPurpose + i)});
}

void Cameras::take(const Pose2& T_map_robot, double before_s, double now_s, std::vector<CameraImage>& images) {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    auto& [model, picture, noise] = cameras_[i];
    if (pictures_until(now_s, model.rate_hz) <= pictures_until(before_s, model.rate_hz)) continue;
    const cv::Mat light = blurred(picture.take(T_map_robot), model);
    auto grey = std::make_shared<std::vector<std::uint8_t>>(light.total());
    for (std::size_t pixel = 0; pixel < grey->size(); ++pixel) {
      const double exposed = model.exposure_ratio * light.ptr<float>()[pixel] + model.noise_ratio * noise.normal();
      (*grey)[pixel] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(exposed, 0.0, 1.0)));
    }
    images.push_back({static_cast<int>(i), now_s, model.width_px, model.height_px, std::move(grey)});
  }
}

}  // namespace cairn
