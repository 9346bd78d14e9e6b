#include "plugins/ros2_robot/messages.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "plugins/common/pictures/grey_picture.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr std::uint8_t kFloat32 = 7;
constexpr std::uint8_t kFloat64 = 8;

template <class Number>
double number_at(const std::uint8_t* at, bool is_bigendian) {
  std::uint8_t bytes[sizeof(Number)];
  std::memcpy(bytes, at, sizeof bytes);
  if (is_bigendian != (std::endian::native == std::endian::big)) std::reverse(std::begin(bytes), std::end(bytes));
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

// A field of a cloud that is a number.
struct CloudField {
  std::size_t offset = 0;
  bool is_double = false;
  [[nodiscard]] double of(const std::uint8_t* point, bool is_bigendian) const {
    return is_double ? number_at<double>(point + offset, is_bigendian) : number_at<float>(point + offset, is_bigendian);
  }
};

CloudField field_of(const PointCloud2& cloud, const std::string& name) {
  for (std::uint32_t i = 0; i < cloud.fields._length; ++i) {
    const auto& field = cloud.fields._buffer[i];
    if (field.name != name) continue;
    const bool is_double = field.datatype == kFloat64;
    if (!is_double && field.datatype != kFloat32)
      throw std::runtime_error("its field " + name + " is neither float nor double");
    if (std::size_t{field.offset} + (is_double ? 8 : 4) > cloud.point_step)
      throw std::runtime_error("its field " + name + " reaches beyond a point");
    return {field.offset, is_double};
  }
  throw std::runtime_error("it has no field " + name);
}

}  // namespace

double seconds_of(const Time& time) {
  return static_cast<double>(time.sec) + 1e-9 * time.nanosec;
}

Time time_of(double seconds) {
  const double whole = std::floor(seconds);
  return {static_cast<std::int32_t>(whole), static_cast<std::uint32_t>(1e9 * (seconds - whole))};
}

ros::Header header_of(const Header& header) {
  return {seconds_of(header.stamp), header.frame_id == nullptr ? "" : header.frame_id};
}

ros::Odometry message_of(const Odometry& odometry) {
  const auto& [position, q] = odometry.pose.pose;
  return {header_of(odometry.header),
          odometry.child_frame_id == nullptr ? "" : odometry.child_frame_id,
          Point(position.x, position.y),
          {q.x, q.y, q.z, q.w}};
}

ros::Range message_of(const Range& range) {
  return {header_of(range.header), range.min_range, range.max_range, range.range};
}

ros::Scan message_of(const LaserScan& scan) {
  return {header_of(scan.header), scan.angle_min, scan.angle_increment,
          scan.range_min,         scan.range_max, {scan.ranges._buffer, scan.ranges._length}};
}

ros::Imu message_of(const Imu& imu) {
  const auto& q = imu.orientation;
  return {{q.x, q.y, q.z, q.w}, imu.orientation_covariance[0] >= 0.0};  // as the message's definition says
}

ros::MagneticField message_of(const MagneticField& field) {
  return {field.magnetic_field.x, field.magnetic_field.y};
}

std::optional<Pose2> pose_of(const geometry_msgs_msg_dds__Pose_& pose) {
  const auto& [position, q] = pose;
  return ros::pose_of({position.x, position.y}, {q.x, q.y, q.z, q.w});
}

std::vector<Point> points_of(const PointCloud& cloud) {
  std::vector<Point> points_m;
  for (std::size_t i = 0; i < std::min<std::size_t>(cloud.points._length, kMaxCloudPoints); ++i)
    points_m.emplace_back(cloud.points._buffer[i].x, cloud.points._buffer[i].y);
  return points_m;
}

std::vector<Point> points_of(const PointCloud2& cloud) {
  std::vector<Point> points_m;
  if (cloud.width == 0 || cloud.height == 0) return points_m;
  const CloudField x = field_of(cloud, "x");
  const CloudField y = field_of(cloud, "y");
  const std::size_t row_step = cloud.height == 1 ? cloud.data._length : cloud.row_step;
  for (std::size_t row = 0; row < cloud.height; ++row)
    for (std::size_t column = 0; column < cloud.width; ++column) {
      if (points_m.size() == kMaxCloudPoints) return points_m;
      const std::size_t at = row * row_step + column * cloud.point_step;
      if (at + cloud.point_step > cloud.data._length) throw std::runtime_error("its data end before its points do");
      const std::uint8_t* const point = cloud.data._buffer + at;
      points_m.emplace_back(x.of(point, cloud.is_bigendian), y.of(point, cloud.is_bigendian));
    }
  return points_m;
}

CameraImage picture_of(const Image& image) {
  return pictures::grey_of({image.width,
                            image.height,
                            image.encoding == nullptr ? "" : image.encoding,
                            image.step,
                            image.is_bigendian != 0,
                            {image.data._buffer, image.data._length}});
}

CameraImage picture_of(const CompressedImage& image) {
  return pictures::unpacked({image.data._buffer, image.data._length});
}

}  // namespace cairn::ros2_robot
