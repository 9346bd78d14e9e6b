#include "maps/exchange/recordings/foxglove_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "maps/base/base64.hpp"

namespace cairn::exchange::foxglove {
namespace {

constexpr std::uint64_t kNsPerS = 1'000'000'000;

// Quoted and escaped; bytes that are no UTF-8 become U+FFFD.
std::string json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string time_text(std::uint64_t time_ns) {
  return fmt::format(R"({{"sec":{},"nsec":{}}})", time_ns / kNsPerS, time_ns % kNsPerS);
}

double finite(double value) {
  return std::isfinite(value) ? value : 0.0;
}

std::string orientation_text(double theta_rad) {
  return fmt::format(R"({{"x":0,"y":0,"z":{},"w":{}}})", finite(std::sin(theta_rad / 2)),
                     finite(std::cos(theta_rad / 2)));
}

std::string vector_text(double x_m, double y_m, double z_m = 0.0) {
  return fmt::format(R"({{"x":{},"y":{},"z":{}}})", finite(x_m), finite(y_m), z_m);
}

std::string pose_text(const Pose2& pose, double z_m = 0.0) {
  return fmt::format(R"({{"position":{},"orientation":{}}})", vector_text(pose.x_m, pose.y_m, z_m),
                     orientation_text(pose.theta_rad));
}

std::string stamped(std::uint64_t time_ns, std::string_view frame) {
  return fmt::format(R"({{"timestamp":{},"frame_id":{})", time_text(time_ns), json_string(frame));
}

GridBytes halved(const GridBytes& grid) {
  const int rows = static_cast<int>(grid.ol.size()) / grid.columns;
  GridBytes half{grid.origin_m, 2.0 * grid.cell_m, (grid.columns + 1) / 2, {}};
  half.ol.assign(static_cast<std::size_t>(half.columns) * static_cast<std::size_t>((rows + 1) / 2), 0);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      std::uint8_t& cell = half.ol[static_cast<std::size_t>(y / 2) * half.columns + x / 2];
      cell = std::max(cell, grid.ol[static_cast<std::size_t>(y) * grid.columns + x]);
    }
  return half;
}

}  // namespace

std::string frame_transform(std::uint64_t time_ns, std::string_view parent, std::string_view child,
                            const Pose2& T_parent_child) {
  return fmt::format(R"({{"timestamp":{},"parent_frame_id":{},"child_frame_id":{},"translation":{},"rotation":{}}})",
                     time_text(time_ns), json_string(parent), json_string(child),
                     vector_text(T_parent_child.x_m, T_parent_child.y_m), orientation_text(T_parent_child.theta_rad));
}

std::string pose_in_frame(std::uint64_t time_ns, std::string_view frame, const Pose2& T_frame_object) {
  return stamped(time_ns, frame) + R"(,"pose":)" + pose_text(T_frame_object) + "}";
}

std::string poses_in_frame(std::uint64_t time_ns, std::string_view frame, std::span<const Pose2> poses) {
  std::string text = stamped(time_ns, frame) + R"(,"poses":[)";
  for (std::size_t i = 0; i < poses.size(); ++i) text += (i == 0 ? "" : ",") + pose_text(poses[i]);
  return text + "]}";
}

std::string log(std::uint64_t time_ns, LogLevel level, std::string_view name, std::string_view message) {
  return fmt::format(R"({{"timestamp":{},"level":{},"message":{},"name":{},"file":"","line":0}})", time_text(time_ns),
                     static_cast<int>(level), json_string(message), json_string(name));
}

std::string laser_scan(std::uint64_t time_ns, std::string_view frame, const Scan& scan) {
  std::string text =
      stamped(time_ns, frame) + fmt::format(R"(,"pose":{},"start_angle":{},"end_angle":{},"ranges":[)",
                                            pose_text(scan.T_frame_laser), scan.first_rad, scan.last_rad);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ",", finite(scan.ranges_m[i]));
  return text + R"(],"intensities":[]})";
}

GridBytes grid_bytes(const OccupancyGrid& grid, int max_side) {
  const CellBox box = grid.bounds();
  if (box.width() <= 0 || box.height() <= 0) return {grid.origin_m(), grid.cell_m(), 0, {}};
  const Point origin_m = grid.origin_m() + grid.cell_m() * Point(box.min.x, box.min.y);
  GridBytes bytes{origin_m, grid.cell_m(), box.width(), {}};
  bytes.ol.resize(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()));
  grid.copy_ol(box, bytes.ol);
  return halved_to(max_side, std::move(bytes));
}

GridBytes halved_to(int max_side, GridBytes bytes) {
  while (bytes.columns > max_side || static_cast<int>(bytes.ol.size()) / std::max(bytes.columns, 1) > max_side)
    bytes = halved(bytes);
  return bytes;
}

std::string grid(std::uint64_t time_ns, std::string_view frame, const GridBytes& grid) {
  return stamped(time_ns, frame) +
         fmt::format(R"(,"pose":{},"column_count":{},"cell_size":{{"x":{},"y":{}}},"row_stride":{},"cell_stride":1,)"
                     R"("fields":[{{"name":"occupancy","offset":0,"type":1}}],"data":")",
                     pose_text({grid.origin_m.x(), grid.origin_m.y(), 0.0}), grid.columns, grid.cell_m, grid.cell_m,
                     grid.columns) +
         base64(grid.ol) + R"("})";
}

std::string landmark(std::uint64_t time_ns, std::string_view frame, const Landmark& landmark) {
  constexpr double kHeight_m = 0.4;
  const std::string cylinder =
      fmt::format(R"({{"pose":{},"size":{{"x":0.2,"y":0.2,"z":{}}},"bottom_scale":1,"top_scale":1,"color":{}}})",
                  pose_text(landmark.T_map_landmark, kHeight_m / 2), kHeight_m, R"({"r":0.9,"g":0.6,"b":0,"a":0.8})");
  const std::string label =
      fmt::format(R"({{"pose":{},"billboard":true,"font_size":14,"scale_invariant":true,"color":{},"text":{}}})",
                  pose_text(landmark.T_map_landmark, 1.5 * kHeight_m), R"({"r":0,"g":0,"b":0,"a":1})",
                  json_string(label_of(landmark)));
  const std::string metadata = fmt::format(
      R"([{{"key":"category","value":{}}},{{"key":"degree","value":"{:.3f}"}},{{"key":"sightings","value":"{}"}}])",
      json_string(landmark.category), landmark.degree, landmark.sightings);
  return R"({"deletions":[],"entities":[)" + stamped(time_ns, frame) +
         fmt::format(
             R"(,"id":"L{}","lifetime":{{"sec":0,"nsec":0}},"frame_locked":true,"metadata":{},"arrows":[],)"
             R"("cubes":[],"spheres":[],"cylinders":[{}],"lines":[],"triangles":[],"texts":[{}],"models":[]}}]}})",
             landmark.id, metadata, cylinder, label);
}

std::string no_landmark(std::uint64_t time_ns, LandmarkId id) {
  return fmt::format(R"({{"deletions":[{{"timestamp":{},"type":0,"id":"L{}"}}],"entities":[]}})", time_text(time_ns),
                     id);
}

}  // namespace cairn::exchange::foxglove
