#include "maps/exchange/recordings/ros2_messages.hpp"

#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace cairn::exchange::ros2 {
namespace {

constexpr std::uint64_t kNsPerS = 1'000'000'000;

// Each number at a multiple of its own size behind the four bytes that name the encoding.
class Cdr {
 public:
  Cdr& u8(std::uint8_t value) { return number(value); }
  Cdr& u32(std::uint32_t value) { return number(value); }
  Cdr& f32(double value) { return number(std::bit_cast<std::uint32_t>(static_cast<float>(value))); }
  Cdr& f64(double value) { return number(std::bit_cast<std::uint64_t>(value)); }
  Cdr& text(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size() + 1));
    bytes_ += value;
    bytes_ += '\0';
    return *this;
  }
  Cdr& time(std::uint64_t time_ns) {
    return u32(static_cast<std::uint32_t>(time_ns / kNsPerS)).u32(static_cast<std::uint32_t>(time_ns % kNsPerS));
  }
  Cdr& header(const Header& header) { return time(header.time_ns).text(header.frame); }
  // A position and an orientation.
  Cdr& pose(const Pose2& pose) {
    f64(pose.x_m).f64(pose.y_m).f64(0.0);
    return orientation(pose.theta_rad);
  }
  Cdr& orientation(double theta_rad) {
    return f64(0.0).f64(0.0).f64(std::sin(theta_rad / 2)).f64(std::cos(theta_rad / 2));
  }
  Cdr& zeros(int count) {
    for (int i = 0; i < count; ++i) f64(0.0);
    return *this;
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  static constexpr std::size_t kEncoding = 4;

  template <class Unsigned>
  Cdr& number(Unsigned value) {
    while ((bytes_.size() - kEncoding) % sizeof(Unsigned) != 0) bytes_ += '\0';
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xFFU);
    return *this;
  }

  std::string bytes_{"\0\1\0\0", kEncoding};  // plain CDR, little-endian
};

constexpr std::string_view kHeader = "std_msgs/Header";
constexpr std::string_view kTime = "builtin_interfaces/Time";
constexpr std::string_view kPose = "geometry_msgs/Pose";
constexpr std::string_view kPoint = "geometry_msgs/Point";
constexpr std::string_view kQuaternion = "geometry_msgs/Quaternion";
constexpr std::string_view kVector3 = "geometry_msgs/Vector3";
constexpr std::string_view kPoseWithCovariance = "geometry_msgs/PoseWithCovariance";
constexpr std::string_view kTwist = "geometry_msgs/Twist";
constexpr std::string_view kTwistWithCovariance = "geometry_msgs/TwistWithCovariance";

std::string_view fields_of(std::string_view type) {
  static constexpr std::pair<std::string_view, std::string_view> kFields[] = {
      {kTime, "int32 sec\nuint32 nanosec\n"},
      {kHeader, "builtin_interfaces/Time stamp\nstring frame_id\n"},
      {kPoint, "float64 x\nfloat64 y\nfloat64 z\n"},
      {kVector3, "float64 x\nfloat64 y\nfloat64 z\n"},
      {kQuaternion, "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
      {kPose, "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
      {"geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
      {"geometry_msgs/TransformStamped",
       "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
      {kPoseWithCovariance, "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
      {kTwist, "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
      {kTwistWithCovariance, "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
      {"nav_msgs/MapMetaData",
       "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\nuint32 height\n"
       "geometry_msgs/Pose origin\n"}};
  for (const auto& [name, fields] : kFields)
    if (name == type) return fields;
  throw std::logic_error("no definition of " + std::string(type));
}

struct Definition {
  std::string_view name;
  std::string_view fields;
  std::vector<std::string_view> uses;
};

Definition definition(Message message) {
  switch (message) {
    case Message::pose_stamped:
      return {"geometry_msgs/msg/PoseStamped",
              "std_msgs/Header header\ngeometry_msgs/Pose pose\n",
              {kHeader, kTime, kPose, kPoint, kQuaternion}};
    case Message::occupancy_grid:
      return {"nav_msgs/msg/OccupancyGrid",
              "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n",
              {kHeader, kTime, "nav_msgs/MapMetaData", kPose, kPoint, kQuaternion}};
    case Message::tf:
      return {"tf2_msgs/msg/TFMessage",
              "geometry_msgs/TransformStamped[] transforms\n",
              {"geometry_msgs/TransformStamped", kHeader, kTime, "geometry_msgs/Transform", kVector3, kQuaternion}};
    case Message::odometry:
      return {
          "nav_msgs/msg/Odometry",
          "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
          "geometry_msgs/TwistWithCovariance twist\n",
          {kHeader, kTime, kPoseWithCovariance, kPose, kPoint, kQuaternion, kTwistWithCovariance, kTwist, kVector3}};
    case Message::range:
      return {"sensor_msgs/msg/Range",
              "uint8 ULTRASOUND=0\nuint8 INFRARED=1\nstd_msgs/Header header\nuint8 radiation_type\n"
              "float32 field_of_view\nfloat32 min_range\nfloat32 max_range\nfloat32 range\n",
              {kHeader, kTime}};
    case Message::laser_scan:
      return {"sensor_msgs/msg/LaserScan",
              "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
              "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n"
              "float32[] ranges\nfloat32[] intensities\n",
              {kHeader, kTime}};
    case Message::imu:
      return {"sensor_msgs/msg/Imu",
              "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n"
              "geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n"
              "geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance\n",
              {kHeader, kTime, kQuaternion, kVector3}};
  }
  throw std::logic_error("no such message of ROS 2");
}

}  // namespace

std::string_view name_of(Message message) {
  return definition(message).name;
}

std::string definition_of(Message message) {
  const Definition whole = definition(message);
  std::string text(whole.fields);
  for (const std::string_view type : whole.uses)
    text += std::string(80, '=') + "\nMSG: " + std::string(type) + "\n" + std::string(fields_of(type));
  return text;
}

std::string pose_stamped(const Header& header, const Pose2& T_frame_object) {
  return Cdr().header(header).pose(T_frame_object).take();
}

std::string tf(const Header& header, std::span<const Transform> transforms) {
  Cdr cdr;
  cdr.u32(static_cast<std::uint32_t>(transforms.size()));
  for (const Transform& transform : transforms) cdr.header(header).text(transform.child).pose(transform.T_frame_child);
  return cdr.take();
}

std::string occupancy_grid(const Header& header, const foxglove::GridBytes& grid) {
  const std::size_t rows = grid.columns == 0 ? 0 : grid.ol.size() / static_cast<std::size_t>(grid.columns);
  Cdr cdr;
  cdr.header(header).time(header.time_ns).f32(grid.cell_m).u32(static_cast<std::uint32_t>(grid.columns));
  cdr.u32(static_cast<std::uint32_t>(rows)).pose({grid.origin_m.x(), grid.origin_m.y(), 0.0});
  cdr.u32(static_cast<std::uint32_t>(grid.ol.size()));
  constexpr int kOlMax = 255;
  for (const std::uint8_t ol : grid.ol)
    cdr.u8(ol == kUnknownOl ? 0xFF : static_cast<std::uint8_t>((100 * ol + kOlMax / 2) / kOlMax));
  return cdr.take();
}

std::string odometry(const Header& header, std::string_view child_frame, const Pose2& T_frame_child) {
  constexpr int kCovariance = 36;
  constexpr int kTwist = 6;
  return Cdr().header(header).text(child_frame).pose(T_frame_child).zeros(kCovariance + kTwist + kCovariance).take();
}

std::string range(const Header& header, const Range& range) {
  const std::uint8_t is_light = range.half_beam_rad == 0.0 ? 1 : 0;
  Cdr cdr;
  cdr.header(header).u8(is_light).f32(2.0 * range.half_beam_rad).f32(range.min_m).f32(range.max_m).f32(range.range_m);
  return cdr.take();
}

std::string laser_scan(const Header& header, const foxglove::Scan& scan, double min_m, double max_m) {
  const auto count = static_cast<std::uint32_t>(scan.ranges_m.size());
  const double step_rad = count > 1 ? (scan.last_rad - scan.first_rad) / (count - 1) : 0.0;
  Cdr cdr;
  cdr.header(header).f32(scan.first_rad).f32(scan.last_rad).f32(step_rad).f32(0.0).f32(0.0).f32(min_m).f32(max_m);
  cdr.u32(count);
  for (const double range_m : scan.ranges_m) cdr.f32(range_m);
  return cdr.u32(0).take();
}

std::string imu(const Header& header, double heading_rad) {
  constexpr int kMatrix = 9;
  constexpr int kVector = 3;
  constexpr double kUnknown = -1.0;
  Cdr cdr;
  cdr.header(header).orientation(heading_rad).zeros(kMatrix);
  for (int i = 0; i < 2; ++i) cdr.zeros(kVector).f64(kUnknown).zeros(kMatrix - 1);  // neither turning nor acceleration
  return cdr.take();
}

}  // namespace cairn::exchange::ros2
