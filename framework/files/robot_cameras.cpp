#include "framework/files/robot_cameras.hpp"

#include <algorithm>
#include <string>

namespace cairn::robot_config {
namespace {

constexpr double kMaxPixels = 8192.0;

void check_pair(const std::vector<double>& numbers, const ConfigValue& value, const char* key) {
  if (numbers.size() == 2) return;
  throw ConfigError(value.place,
                    std::string(key) + " must be two numbers [x, y], found " + std::to_string(numbers.size()));
}

void check_centre(const CameraModel& camera, const ConfigValue& value) {
  const bool is_inside = camera.centre_x_px < camera.width_px && camera.centre_y_px < camera.height_px;
  if (is_inside) return;
  using config_detail::number_text;
  throw ConfigError(value.place, "centre_px must lie in the picture of " + std::to_string(camera.width_px) + " x " +
                                     std::to_string(camera.height_px) + " pixels, found [" +
                                     number_text(camera.centre_x_px) + ", " + number_text(camera.centre_y_px) + "]");
}

}  // namespace

void CameraConfig::describe(Fields<CameraConfig>& fields) {
  fields.number("x_m", &CameraConfig::x_m, {-10.0, 10.0}, "m", "place of the lens on the robot, ahead of its centre")
      .required = true;
  fields.number("y_m", &CameraConfig::y_m, {-10.0, 10.0}, "m", "left of its centre").required = true;
  fields.number("height_m", &CameraConfig::height_m, {0.0, 10.0}, "m", "of the lens above the floor").required = true;
  fields.angle("angle_deg", &CameraConfig::angle_rad, {-360.0, 360.0}, "which way it looks, anticlockwise from ahead");
  fields.angle("tilt_deg", &CameraConfig::tilt_rad, {-89.0, 89.0}, "how far it looks up from level; negative: down");
  fields.integer("width_px", static_cast<int CameraConfig::*>(&CameraModel::width_px), {16, kMaxPixels},
                 "width of its pictures");
  fields.integer("height_px", static_cast<int CameraConfig::*>(&CameraModel::height_px), {16, kMaxPixels},
                 "height of its pictures");
  fields
      .numbers("focal_px", &CameraConfig::focal_px, {1.0, 1e6}, "px",
               "focal length across and down (fx, fy), as a calibration of pictures of this size has it")
      .required = true;
  fields.numbers("centre_px", &CameraConfig::centre_px, {0.0, kMaxPixels}, "px",
                 "where its axis meets the picture (cx, cy), counted from the centre of the upper left pixel; the "
                 "middle of the picture when left out");
  fields.numbers("distortion", &CameraConfig::distortion_numbers, {-100.0, 100.0}, "",
                 "of its lens: k1, k2, p1, p2, k3 (Brown's model, in OpenCV's order); 0 where left out");
  fields.number("rate_hz", &CameraConfig::rate_hz, {0.01, 1000.0}, "1/s", "pictures a second");
  fields.number("blur_px", &CameraConfig::blur_px, {0.0, 100.0}, "px",
                "simulation: how blurred its pictures are, standard deviation");
  fields.number("noise_ratio", &CameraConfig::noise_ratio, {0.0, 1.0}, "",
                "simulation: error of a pixel, as a share of the full range");
  fields.number("exposure_ratio", &CameraConfig::exposure_ratio, {0.0, 10.0}, "",
                "simulation: grey of a white surface, as a share of the full range; above 1 it is overexposed");
}

CameraModel camera_of(const CameraConfig& config, const ConfigValue& value) {
  CameraModel camera = config;
  camera.T_robot_camera = {config.x_m, config.y_m, wrap_angle(config.angle_rad)};
  check_pair(config.focal_px, *value.find("focal_px"), "focal_px");
  camera.focal_x_px = config.focal_px[0];
  camera.focal_y_px = config.focal_px[1];
  camera.centre_x_px = 0.5 * (camera.width_px - 1);
  camera.centre_y_px = 0.5 * (camera.height_px - 1);
  if (const ConfigValue* centre = value.find("centre_px")) {
    check_pair(config.centre_px, *centre, "centre_px");
    camera.centre_x_px = config.centre_px[0];
    camera.centre_y_px = config.centre_px[1];
    check_centre(camera, *centre);
  }
  if (config.distortion_numbers.size() > camera.distortion.size())
    throw ConfigError(value.find("distortion")->place, "distortion has 5 numbers at most (k1, k2, p1, p2, k3), found " +
                                                           std::to_string(config.distortion_numbers.size()));
  std::ranges::copy(config.distortion_numbers, camera.distortion.begin());
  return camera;
}

}  // namespace cairn::robot_config
