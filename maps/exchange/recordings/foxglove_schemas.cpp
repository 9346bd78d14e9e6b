#include "maps/exchange/recordings/foxglove_schemas.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace cairn::exchange {
namespace {

using Json = nlohmann::ordered_json;
using Members = std::initializer_list<std::pair<const char*, Json>>;

Json number() {
  return {{"type", "number"}};
}
Json text() {
  return {{"type", "string"}};
}
Json boolean() {
  return {{"type", "boolean"}};
}
Json count() {
  return {{"type", "integer"}, {"minimum", 0}};
}
Json base64() {
  return {{"type", "string"}, {"contentEncoding", "base64"}};
}
Json list(Json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

Json object(std::string_view title, Members members) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const auto& [name, schema] : members) {
    properties[name] = schema;
    required.push_back(name);
  }
  return {{"title", title}, {"type", "object"}, {"properties", properties}, {"required", required}};
}

// Numbered from 0.
Json choice(std::string_view title, std::initializer_list<const char*> names) {
  Json one_of = Json::array();
  for (const char* const name : names) one_of.push_back({{"title", name}, {"const", one_of.size()}});
  return {{"title", title}, {"oneOf", one_of}};
}

Json nanoseconds() {
  return {{"type", "integer"}, {"minimum", 0}, {"maximum", 999999999}};
}
Json time() {
  return {{"type", "object"}, {"title", "time"}, {"properties", {{"sec", count()}, {"nsec", nanoseconds()}}}};
}
Json duration() {
  return {{"type", "object"},
          {"title", "duration"},
          {"properties", {{"sec", {{"type", "integer"}}}, {"nsec", nanoseconds()}}}};
}
Json vector2() {
  return object("foxglove.Vector2", {{"x", number()}, {"y", number()}});
}
Json vector3(std::string_view title = "foxglove.Vector3") {
  return object(title, {{"x", number()}, {"y", number()}, {"z", number()}});
}
Json quaternion() {
  return object("foxglove.Quaternion", {{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}
Json pose() {
  return object("foxglove.Pose", {{"position", vector3()}, {"orientation", quaternion()}});
}
Json color() {
  return object("foxglove.Color", {{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

Json arrow() {
  return object("foxglove.ArrowPrimitive", {{"pose", pose()},
                                            {"shaft_length", number()},
                                            {"shaft_diameter", number()},
                                            {"head_length", number()},
                                            {"head_diameter", number()},
                                            {"color", color()}});
}
// Of cubes and spheres.
Json sized(std::string_view title) {
  return object(title, {{"pose", pose()}, {"size", vector3()}, {"color", color()}});
}
Json cylinder() {
  return object(
      "foxglove.CylinderPrimitive",
      {{"pose", pose()}, {"size", vector3()}, {"bottom_scale", number()}, {"top_scale", number()}, {"color", color()}});
}
Json line() {
  return object("foxglove.LinePrimitive",
                {{"type", choice("foxglove.LineType", {"LINE_STRIP", "LINE_LOOP", "LINE_LIST"})},
                 {"pose", pose()},
                 {"thickness", number()},
                 {"scale_invariant", boolean()},
                 {"points", list(vector3("foxglove.Point3"))},
                 {"color", color()},
                 {"colors", list(color())},
                 {"indices", list(count())}});
}
Json triangles() {
  return object("foxglove.TriangleListPrimitive", {{"pose", pose()},
                                                   {"points", list(vector3("foxglove.Point3"))},
                                                   {"color", color()},
                                                   {"colors", list(color())},
                                                   {"indices", list(count())}});
}
Json label() {
  return object("foxglove.TextPrimitive", {{"pose", pose()},
                                           {"billboard", boolean()},
                                           {"font_size", number()},
                                           {"scale_invariant", boolean()},
                                           {"color", color()},
                                           {"text", text()}});
}
Json model() {
  return object("foxglove.ModelPrimitive", {{"pose", pose()},
                                            {"scale", vector3()},
                                            {"color", color()},
                                            {"override_color", boolean()},
                                            {"url", text()},
                                            {"media_type", text()},
                                            {"data", base64()}});
}

Json entity() {
  return object("foxglove.SceneEntity",
                {{"timestamp", time()},
                 {"frame_id", text()},
                 {"id", text()},
                 {"lifetime", duration()},
                 {"frame_locked", boolean()},
                 {"metadata", list(object("foxglove.KeyValuePair", {{"key", text()}, {"value", text()}}))},
                 {"arrows", list(arrow())},
                 {"cubes", list(sized("foxglove.CubePrimitive"))},
                 {"spheres", list(sized("foxglove.SpherePrimitive"))},
                 {"cylinders", list(cylinder())},
                 {"lines", list(line())},
                 {"triangles", list(triangles())},
                 {"texts", list(label())},
                 {"models", list(model())}});
}

Json deletion() {
  return object("foxglove.SceneEntityDeletion",
                {{"timestamp", time()},
                 {"type", choice("foxglove.SceneEntityDeletionType", {"MATCHING_ID", "ALL"})},
                 {"id", text()}});
}

Json packed_field() {
  return object("foxglove.PackedElementField",
                {{"name", text()},
                 {"offset", count()},
                 {"type", choice("foxglove.NumericType", {"UNKNOWN", "UINT8", "INT8", "UINT16", "INT16", "UINT32",
                                                          "INT32", "FLOAT32", "FLOAT64"})}});
}

Json grid() {
  return object("foxglove.Grid", {{"timestamp", time()},
                                  {"frame_id", text()},
                                  {"pose", pose()},
                                  {"column_count", count()},
                                  {"cell_size", vector2()},
                                  {"row_stride", count()},
                                  {"cell_stride", count()},
                                  {"fields", list(packed_field())},
                                  {"data", base64()}});
}

Json laser_scan() {
  return object("foxglove.LaserScan", {{"timestamp", time()},
                                       {"frame_id", text()},
                                       {"pose", pose()},
                                       {"start_angle", number()},
                                       {"end_angle", number()},
                                       {"ranges", list(number())},
                                       {"intensities", list(number())}});
}

Json log() {
  return object("foxglove.Log",
                {{"timestamp", time()},
                 {"level", choice("foxglove.LogLevel", {"UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"})},
                 {"message", text()},
                 {"name", text()},
                 {"file", text()},
                 {"line", count()}});
}

Json frame_transform() {
  return object("foxglove.FrameTransform", {{"timestamp", time()},
                                            {"parent_frame_id", text()},
                                            {"child_frame_id", text()},
                                            {"translation", vector3()},
                                            {"rotation", quaternion()}});
}

Json json_schema_of(FoxgloveMessage message) {
  switch (message) {
    case FoxgloveMessage::frame_transform:
      return frame_transform();
    case FoxgloveMessage::grid:
      return grid();
    case FoxgloveMessage::laser_scan:
      return laser_scan();
    case FoxgloveMessage::log:
      return log();
    case FoxgloveMessage::pose_in_frame:
      return object("foxglove.PoseInFrame", {{"timestamp", time()}, {"frame_id", text()}, {"pose", pose()}});
    case FoxgloveMessage::poses_in_frame:
      return object("foxglove.PosesInFrame", {{"timestamp", time()}, {"frame_id", text()}, {"poses", list(pose())}});
    case FoxgloveMessage::scene_update:
      return object("foxglove.SceneUpdate", {{"deletions", list(deletion())}, {"entities", list(entity())}});
  }
  throw std::logic_error("no such message of Foxglove");
}

}  // namespace

std::string name_of(FoxgloveMessage message) {
  return json_schema_of(message).at("title");
}

std::string schema_of(FoxgloveMessage message) {
  return json_schema_of(message).dump();
}

}  // namespace cairn::exchange
