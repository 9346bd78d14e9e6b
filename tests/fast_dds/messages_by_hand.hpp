// Messages as the .msg files of ROS 2 Humble to Jazzy list their fields, one after the other.
#pragma once

#include <fastcdr/Cdr.h>

#include <array>
#include <string>
#include <vector>

namespace cairn::fast_dds {

using eprosima::fastcdr::Cdr;

struct Stamped {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::string frame;
};
inline void write_header(Cdr& to, const Stamped& header) {
  to << header.sec << header.nanosec << header.frame;
}
inline Stamped read_header(Cdr& from) {
  Stamped header;
  from >> header.sec >> header.nanosec >> header.frame;
  return header;
}
template <std::size_t count>
std::array<double, count> read_numbers(Cdr& from) {
  std::array<double, count> numbers{};
  from >> numbers;
  return numbers;
}
using PoseNumbers = std::array<double, 7>;   // x y z, quaternion x y z w
using TwistNumbers = std::array<double, 6>;  // linear, angular

inline void write_odometry(Cdr& to, const Stamped& header, const std::string& child, const PoseNumbers& pose) {
  write_header(to, header);
  to << child << pose << std::array<double, 36>{} << TwistNumbers{} << std::array<double, 36>{};
}
inline void write_range(Cdr& to, const Stamped& header, float range_m) {
  write_header(to, header);
  to << std::uint8_t{0} << 0.5F << 0.1F << 5.0F << range_m;
}
inline void write_scan(Cdr& to, const Stamped& header, const std::vector<float>& ranges) {
  write_header(to, header);
  to << -0.5F << 0.5F << 0.5F << 0.0F << 0.1F << 0.1F << 10.0F << ranges << std::vector<float>{};
}
inline void write_image(Cdr& to, const Stamped& header, std::uint32_t height_px, std::uint32_t width_px,
                        const std::string& encoding, std::uint32_t step, const std::vector<std::uint8_t>& data) {
  write_header(to, header);
  to << height_px << width_px << encoding << std::uint8_t{0} << step << data;
}
inline void write_compressed_image(Cdr& to, const Stamped& header, const std::string& format, const std::string& data) {
  write_header(to, header);
  to << format << std::vector<std::uint8_t>(data.begin(), data.end());
}
inline void write_bool(Cdr& to, bool value) {
  to << value;
}
inline void write_imu(Cdr& to, const Stamped& header, const std::array<double, 4>& orientation) {
  write_header(to, header);
  to << orientation << std::array<double, 9>{} << std::array<double, 3>{} << std::array<double, 9>{}
     << std::array<double, 3>{} << std::array<double, 9>{};
}
inline void write_battery(Cdr& to, const Stamped& header, float percentage) {
  write_header(to, header);
  to << 12.0F << 20.0F << -1.0F << 1.0F << 2.0F << 2.0F << percentage << std::uint8_t{2} << std::uint8_t{1}
     << std::uint8_t{2} << true << std::vector<float>{4.0F} << std::vector<float>{} << std::string("slot")
     << std::string("42");
}
struct HandTransform {
  Stamped header;
  std::string child;
  PoseNumbers pose{};
};
inline void write_transforms(Cdr& to, const std::vector<HandTransform>& transforms) {
  to << static_cast<std::uint32_t>(transforms.size());
  for (const HandTransform& transform : transforms) {
    write_header(to, transform.header);
    to << transform.child << transform.pose;
  }
}
inline std::vector<HandTransform> read_transforms(Cdr& from) {
  std::uint32_t count = 0;
  from >> count;
  std::vector<HandTransform> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    HandTransform& one = all.emplace_back();
    one.header = read_header(from);
    from >> one.child >> one.pose;
  }
  return all;
}

struct HandGrid {
  Stamped header;
  float resolution = 0.0F;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  PoseNumbers origin{};
  std::vector<std::uint8_t> cells;
};
inline HandGrid read_grid(Cdr& from) {
  HandGrid grid;
  grid.header = read_header(from);
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  from >> sec >> nanosec >> grid.resolution >> grid.width >> grid.height >> grid.origin >> grid.cells;
  return grid;
}

struct HandMarker {
  Stamped header;
  std::string group;
  std::array<std::int32_t, 3> id_type_action{};
  PoseNumbers pose{};
  std::string text;
};
inline HandMarker read_marker(Cdr& from) {
  HandMarker marker;
  marker.header = read_header(from);
  from >> marker.group >> marker.id_type_action >> marker.pose;
  std::array<double, 3> scale{};
  std::array<float, 4> color{};
  std::int32_t lifetime_sec = 0;
  std::uint32_t lifetime_nanosec = 0;
  bool is_locked = false;
  std::uint32_t points = 0;
  std::uint32_t colors = 0;
  std::string texture_resource;
  from >> scale >> color >> lifetime_sec >> lifetime_nanosec >> is_locked >> points >> colors >> texture_resource;
  (void)read_header(from);
  std::string format;
  std::vector<std::uint8_t> picture;
  std::uint32_t coordinates = 0;
  std::string mesh;
  std::string mesh_file;
  std::vector<std::uint8_t> mesh_data;
  bool uses_materials = false;
  from >> format >> picture >> coordinates >> marker.text >> mesh >> mesh_file >> mesh_data >> uses_materials;
  return marker;
}

struct HandStatus {
  std::uint8_t level = 0;
  std::string name;
  std::string message;
  std::string hardware;
  std::vector<std::pair<std::string, std::string>> values;
};
inline std::vector<HandStatus> read_diagnostics(Cdr& from) {
  (void)read_header(from);
  std::uint32_t count = 0;
  from >> count;
  std::vector<HandStatus> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    HandStatus& status = all.emplace_back();
    std::uint32_t values = 0;
    from >> status.level >> status.name >> status.message >> status.hardware >> values;
    for (std::uint32_t k = 0; k < values; ++k) {
      auto& [key, value] = status.values.emplace_back();
      from >> key >> value;
    }
  }
  return all;
}

}  // namespace cairn::fast_dds
