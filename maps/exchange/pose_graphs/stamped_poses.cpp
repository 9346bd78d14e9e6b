#include "maps/exchange/pose_graphs/stamped_poses.hpp"

#include <fmt/format.h>

#include <cmath>

#include "maps/base/source_text.hpp"
#include "maps/base/spelling.hpp"
#include "maps/exchange/graphs/line_tokens.hpp"

namespace cairn {
namespace {

using exchange::LineTokens;
using exchange::SourceText;

constexpr const char* kPoseForm = "T X Y THETA, or T X Y Z QX QY QZ QW";
constexpr const char* kRelationForm = "T1 T2 DX DY DZ ROLL PITCH YAW";

// Whether the line holds values: a copy of it looks ahead.
bool holds_values(LineTokens line) {
  const std::string_view first = line.token();
  return !first.empty() && !first.starts_with('#');
}

bool is_at_end(LineTokens line) {
  return line.token().empty();
}

void refuse_more(LineTokens& line, const char* form) {
  if (const std::string_view more = line.rest(); !more.empty()) line.fail(in_quotes(more) + " is too much: " + form);
}

StampedPose pose_in(LineTokens& line) {
  StampedPose pose;
  pose.stamp_s = line.number("the stamp", kPoseForm);
  pose.T_map_robot.x_m = line.coordinate_m("x", kPoseForm);
  pose.T_map_robot.y_m = line.coordinate_m("y", kPoseForm);
  const double third = line.number("theta", kPoseForm);
  if (is_at_end(line)) {
    pose.T_map_robot.theta_rad = wrap_angle(third);
    return pose;
  }
  const double qx = line.number("qx", kPoseForm);
  const double qy = line.number("qy", kPoseForm);
  const double qz = line.number("qz", kPoseForm);
  const double qw = line.number("qw", kPoseForm);
  pose.T_map_robot.theta_rad = std::atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz));
  refuse_more(line, kPoseForm);
  return pose;
}

StatedRelation relation_in(LineTokens& line) {
  StatedRelation relation;
  relation.from_s = line.number("t1", kRelationForm);
  relation.to_s = line.number("t2", kRelationForm);
  relation.T_from_to.x_m = line.coordinate_m("dx", kRelationForm);
  relation.T_from_to.y_m = line.coordinate_m("dy", kRelationForm);
  for (const char* const unused : {"dz", "roll", "pitch"}) (void)line.number(unused, kRelationForm);
  relation.T_from_to.theta_rad = wrap_angle(line.number("yaw", kRelationForm));
  refuse_more(line, kRelationForm);
  return relation;
}

template <class Item>
std::vector<Item> parse_lines(std::string_view text, const std::string& file_name, Item (*item_in)(LineTokens&),
                              const char* form) {
  const SourceText source(text, file_name);
  LineTokens line(source);
  std::vector<Item> items;
  while (line.next_line())
    if (holds_values(line)) items.push_back(item_in(line));
  if (items.empty()) source.fail("holds no line " + std::string(form));
  return items;
}

}  // namespace

std::vector<StampedPose> parse_stamped_poses(std::string_view text, const std::string& file_name) {
  return parse_lines(text, file_name, pose_in, kPoseForm);
}

std::string tum_of(std::span<const StampedPose> poses) {
  std::string text;
  for (const auto& [stamp_s, T_map_robot] : poses) {
    const double half_rad = 0.5 * T_map_robot.theta_rad;
    text += fmt::format("{} {} {} 0 0 0 {} {}\n", stamp_s, T_map_robot.x_m, T_map_robot.y_m, std::sin(half_rad),
                        std::cos(half_rad));
  }
  return text;
}

std::vector<StatedRelation> parse_relations(std::string_view text, const std::string& file_name) {
  return parse_lines(text, file_name, relation_in, kRelationForm);
}

}  // namespace cairn
