#include "plugins/simulated_robot/camera/picture.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kReach_m = 40.0;
constexpr double kWallHeight_m = 2.5;
constexpr double kPaper_m = 0.02;  // a tag is at most so far behind the face that it hangs on
constexpr int kMarginCells = 1;    // of white paper round a tag
constexpr int kSubpixels = 4;      // along each side of a pixel
constexpr double kNeighbourCells = 4.0;
constexpr double kSmallPixel = 0.3;  // of a cell
constexpr float kFloor = 0.35F;
constexpr float kCeiling = 0.9F;
constexpr float kBlack = 0.05F;

// Two walls that meet are told apart by the light from one side.
float wall_grey(const Point& a_m, const Point& b_m) {
  const Point along = b_m - a_m;
  const double length_m = along.norm();
  return length_m > 1e-9 ? static_cast<float>(0.5 + 0.2 * std::abs(along.x() * 0.8 + along.y() * 0.6) / length_m)
                         : 0.6F;
}

}  // namespace

// In the frame of the robot, moved and turned to the camera.
class Picture::HungTag {
 public:
  struct Spot {
    float light;
    double distance_m;  // on the floor plan
    double bearing_rad;
  };

  HungTag(const WorldTag& tag, const TagPattern& pattern, const Pose2& T_camera_tag, double camera_height_m)
      : pattern_(pattern),
        cell_m_(tag.size_m / pattern.detected_cells),
        centre_m_(T_camera_tag.position()),
        up_m_(tag.height_m - camera_height_m),
        normal_(std::cos(T_camera_tag.theta_rad), std::sin(T_camera_tag.theta_rad)),
        right_(-normal_.y(), normal_.x()) {}

  [[nodiscard]] double half_m() const { return (0.5 * pattern_.cells + kMarginCells) * cell_m_; }
  [[nodiscard]] bool is_seen_from_front() const { return centre_m_.dot(normal_) < 0.0 && centre_m_.norm() < kReach_m; }

  // Whether a ray passes the tag and its margin by so many cells more, so that its neighbours do too.
  [[nodiscard]] bool is_passed_by(const Eigen::Vector3d& direction, double cells) const {
    const Point along(direction.x(), direction.y());
    const double closing = along.dot(normal_);
    if (closing >= 0.0) return true;
    const double t = centre_m_.dot(normal_) / closing;
    const double half_m = (0.5 * pattern_.cells + kMarginCells + cells) * cell_m_;
    return std::abs(right_.dot(t * along - centre_m_)) > half_m || std::abs(up_m_ - t * direction.z()) > half_m;
  }
  // Cells that a pixel at the tag's centre covers, at least: less where it slants.
  [[nodiscard]] double cells_in_pixel(double focal_px) const { return centre_m_.norm() / (focal_px * cell_m_); }

  // Where a ray from the lens meets the tag or its margin; nothing beside it.
  [[nodiscard]] std::optional<Spot> spot_on(const Eigen::Vector3d& direction) const {
    const Point along(direction.x(), direction.y());
    const double closing = along.dot(normal_);
    if (closing >= 0.0) return std::nullopt;
    const double t = centre_m_.dot(normal_) / closing;
    const Point at_m = t * along;
    const double column = right_.dot(at_m - centre_m_) / cell_m_ + 0.5 * pattern_.cells;
    const double row = (up_m_ - t * direction.z()) / cell_m_ + 0.5 * pattern_.cells;
    if (!is_within(column, kMarginCells) || !is_within(row, kMarginCells)) return std::nullopt;
    return Spot{is_white(column, row) ? 1.0F : kBlack, at_m.norm(), std::atan2(along.y(), along.x())};
  }

 private:
  [[nodiscard]] bool is_within(double cells, double margin) const {
    return cells >= -margin && cells < pattern_.cells + margin;
  }
  [[nodiscard]] bool is_white(double column, double row) const {
    if (!is_within(column, 0.0) || !is_within(row, 0.0)) return true;
    return pattern_.white[static_cast<std::size_t>(row) * static_cast<std::size_t>(pattern_.cells) +
                          static_cast<std::size_t>(column)];
  }

  const TagPattern& pattern_;
  double cell_m_;
  Point centre_m_;
  double up_m_;
  Point normal_;
  Point right_;  // of who looks at it
};

Picture::Picture(const CameraModel& camera, const Scene& scene, const std::vector<WorldTag>& tags)
    : camera_(camera), scene_(scene), tags_(tags) {
  patterns_.reserve(tags.size());
  for (const WorldTag& tag : tags) patterns_.push_back(pattern_of(tag.marker));
  const auto pixels = static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  on_plane_.reserve(pixels);
  bearing_rad_.reserve(pixels);
  slope_.reserve(pixels);
  for (int y = 0; y < camera.height_px; ++y)
    for (int x = 0; x < camera.width_px; ++x) {
      const Eigen::Vector2d p = undistorted(camera, {x, y});
      const Eigen::Vector3d d = direction_of(camera, p);
      on_plane_.push_back(p.cast<float>());
      bearing_rad_.push_back(static_cast<float>(std::atan2(d.y(), d.x())));
      slope_.push_back(static_cast<float>(d.z() / std::max(1e-6, std::hypot(d.x(), d.y()))));
    }
  light_.resize(pixels);
  const auto [first, last] = std::ranges::minmax(bearing_rad_);
  step_rad_ = 0.5 / camera.focal_x_px;
  first_rad_ = first;
  wall_m_.resize(static_cast<std::size_t>((last - first) / step_rad_) + 2);
  wall_grey_.resize(wall_m_.size());
}

const std::vector<float>& Picture::take(const Pose2& T_map_robot) {
  draw_surroundings(T_map_robot * camera_.T_robot_camera);
  for (std::size_t i = 0; i < tags_.size(); ++i) draw_tag(tags_[i], patterns_[i], T_map_robot);
  return light_;
}

std::size_t Picture::ray_at(double bearing_rad) const {
  const double ray = std::round((bearing_rad - first_rad_) / step_rad_);
  return static_cast<std::size_t>(std::clamp(ray, 0.0, static_cast<double>(wall_m_.size() - 1)));
}

void Picture::draw_surroundings(const Pose2& T_map_camera) {
  scene_.cast_fan({T_map_camera.position(), T_map_camera.theta_rad + first_rad_, step_rad_, kReach_m}, wall_m_);
  const auto place = [&](std::size_t i) {
    const double bearing_rad = T_map_camera.theta_rad + first_rad_ + static_cast<double>(i) * step_rad_;
    return Point(wall_m_[i] * std::cos(bearing_rad), wall_m_[i] * std::sin(bearing_rad));
  };
  for (std::size_t i = 0; i + 1 < wall_m_.size(); ++i)
    wall_grey_[i] = std::isfinite(wall_m_[i] + wall_m_[i + 1]) ? wall_grey(place(i), place(i + 1)) : 0.6F;
  wall_grey_.back() = wall_grey_[wall_grey_.size() - 2];
  for (std::size_t i = 0; i < light_.size(); ++i) {
    const std::size_t ray = ray_at(bearing_rad_[i]);
    const double up_m = camera_.height_m + std::min(wall_m_[ray], kReach_m) * slope_[i];
    light_[i] = up_m < 0.0 ? kFloor : up_m > kWallHeight_m ? kCeiling : wall_grey_[ray];
  }
}

// The whole picture when a corner is behind the lens.
Picture::Box Picture::box_of(const WorldTag& tag, const Pose2& T_robot_tag, double half_m) const {
  Pixel low{camera_.width_px, camera_.height_px};
  Pixel high{-1.0, -1.0};
  for (const double across : {-half_m, half_m})
    for (const double up : {-half_m, half_m}) {
      const Point p = T_robot_tag * Point(0.0, across);
      const std::optional<Pixel> pixel = pixel_of(camera_, {p.x(), p.y(), tag.height_m + up});
      if (!pixel) return {0, 0, camera_.width_px, camera_.height_px};
      low = low.cwiseMin(*pixel);
      high = high.cwiseMax(*pixel);
    }
  // Distorted sides bend outwards by less.
  const Pixel margin = 0.1 * (high - low).cwiseMax(0.0) + Pixel(2.0, 2.0);
  const auto within = [](double value, int size) { return static_cast<int>(std::clamp<double>(value, 0.0, size)); };
  return {within(std::floor(low.x() - margin.x()), camera_.width_px),
          within(std::floor(low.y() - margin.y()), camera_.height_px),
          within(std::ceil(high.x() + margin.x()) + 1.0, camera_.width_px),
          within(std::ceil(high.y() + margin.y()) + 1.0, camera_.height_px)};
}

void Picture::draw_tag(const WorldTag& tag, const TagPattern& pattern, const Pose2& T_map_robot) {
  const Pose2 T_robot_tag = inverse(T_map_robot) * tag.T_map_tag;
  const HungTag hung(tag, pattern, inverse(camera_.T_robot_camera) * T_robot_tag, camera_.height_m);
  if (!hung.is_seen_from_front()) return;
  const Box box = box_of(tag, T_robot_tag, hung.half_m());
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width_px) + static_cast<std::size_t>(x);
      light_[pixel] = tag_light(hung, pixel);
    }
}

// Of a part of a pixel, counted from its upper left.
float Picture::tag_light(const HungTag& hung, std::size_t pixel, int row, int column) const {
  const Eigen::Vector2d focal_px(camera_.focal_x_px, camera_.focal_y_px);
  const Eigen::Vector2d offset_px((column + 0.5) / kSubpixels - 0.5, (row + 0.5) / kSubpixels - 0.5);
  const Eigen::Vector2d on_plane = on_plane_[pixel].cast<double>() + offset_px.cwiseQuotient(focal_px);
  const std::optional<HungTag::Spot> spot = hung.spot_on(direction_of(camera_, on_plane));
  const bool is_hidden = !spot || spot->distance_m > wall_m_[ray_at(spot->bearing_rad)] + kPaper_m;
  return is_hidden ? light_[pixel] : spot->light;
}

// Where cells are larger than pixels, one whose corners are of the same light is so as a whole.
float Picture::tag_light(const HungTag& hung, std::size_t pixel) const {
  if (hung.is_passed_by(direction_of(camera_, on_plane_[pixel].cast<double>()), kNeighbourCells)) return light_[pixel];
  if (hung.cells_in_pixel(camera_.focal_x_px) < kSmallPixel) {
    const float first = tag_light(hung, pixel, 0, 0);
    constexpr int kLast = kSubpixels - 1;
    if (first == tag_light(hung, pixel, 0, kLast) && first == tag_light(hung, pixel, kLast, 0) &&
        first == tag_light(hung, pixel, kLast, kLast))
      return first;
  }
  float sum = 0.0F;
  for (int part = 0; part < kSubpixels * kSubpixels; ++part)
    sum += tag_light(hung, pixel, part / kSubpixels, part % kSubpixels);
  return sum / static_cast<float>(kSubpixels * kSubpixels);
}

}  // namespace cairn
