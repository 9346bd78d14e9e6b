#include <algorithm>
#include <cmath>
#include <map>

#include "framework/config/fields.hpp"
#include "framework/files/rmf_site.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"

namespace cairn::rmf {
namespace {

const std::vector<std::string> kSiteKeys{
    "levels", "name",       "building_name", "coordinate_system", "reference_level_name", "crowd_sim",
    "graphs", "parameters", "lifts",         "georeference"};
const std::vector<std::string> kLevelKeys{
    "vertices", "lanes",    "measurements",       "fiducials",          "elevation", "constraints", "doors",
    "drawing",  "features", "flattened_x_offset", "flattened_y_offset", "floors",    "holes",       "layers",
    "models",   "walls",    "human_lanes",        "x_meters",           "y_meters",  "zones"};

// {name: [type, value]} as {name: value}.
Properties properties_of(const ConfigValue& edge, std::size_t position) {
  Properties properties;
  if (edge.items.size() <= position) return properties;
  for (const ConfigValue::Entry& entry : edge.items[position].entries) {
    const ConfigValue& typed = entry.value;
    if (typed.kind != ConfigValue::Kind::list || typed.items.size() != 2)
      throw ConfigError(typed.place, entry.key + " must be [type, value], found " + typed.kind_name());
    properties.entries.emplace_back(entry.key, typed.items[1]);
  }
  return properties;
}

struct Fiducial {
  Point at{0.0, 0.0};
  std::string name;
};

// p_building = shift + scale * turned by `turn_rad`
struct Transform {
  double scale = 1.0;
  double turn_rad = 0.0;
  Point shift{0.0, 0.0};

  [[nodiscard]] Point operator()(const Point& p) const { return shift + scale * (Pose2{0.0, 0.0, turn_rad} * p); }
};

class Drawing {  // one level, in its own units, y upwards
 public:
  Drawing(const ConfigValue& level, std::string name, double y_sign) : level_(level), name_(std::move(name)) {
    for (const ConfigValue& vertex : list_in(level, "vertices")) {
      if (vertex.kind != ConfigValue::Kind::list || vertex.items.size() < 4)
        throw ConfigError(vertex.place, "a vertex must be [x, y, z, name, {...}], found " + vertex.kind_name());
      vertices_.push_back(
          {point(vertex, y_sign), name_in(vertex.items[3], "the vertex's name"), properties_of(vertex, 4)});
    }
    for (const ConfigValue& fiducial : list_in(level, "fiducials")) {
      if (fiducial.kind != ConfigValue::Kind::list || fiducial.items.size() < 3)
        throw ConfigError(fiducial.place, "a fiducial must be [x, y, name], found " + fiducial.kind_name());
      fiducials_.push_back({point(fiducial, y_sign), name_in(fiducial.items[2], "the fiducial's name")});
    }
  }

  // Metres a unit by the mean of the measurements; 0 without any.
  [[nodiscard]] double measured_scale() const {
    double sum = 0.0;
    const auto& measurements = list_in(level_, "measurements");
    for (const ConfigValue& measurement : measurements) {
      const Point a = vertices_[vertex_index(measurement, 0, vertices_.size())].at_m;
      const Point b = vertices_[vertex_index(measurement, 1, vertices_.size())].at_m;
      const Properties properties = properties_of(measurement, 2);
      const ConfigValue* distance = properties.find("distance");
      if (distance == nullptr) throw ConfigError(measurement.place, "a measurement lacks its \"distance\"");
      const double metres = config_detail::to_number(*distance, "distance", {1e-9, 1e6}, "m");
      const double units = (a - b).norm();
      if (units == 0.0) throw ConfigError(measurement.place, "a measurement between two vertices of one place");
      sum += metres / units;
    }
    return measurements.empty() ? 0.0 : sum / static_cast<double>(measurements.size());
  }

  // By two or more fiducials of one name in both; else only by its own measurements.
  [[nodiscard]] Transform onto(const Drawing& reference, double reference_scale,
                               std::vector<std::string>& warnings) const {
    std::vector<std::pair<Point, Point>> common;
    for (const Fiducial& there : reference.fiducials_)
      for (const Fiducial& here : fiducials_)
        if (there.name == here.name) common.emplace_back(there.at, here.at);
    Transform transform;
    double sines = 0.0;
    double cosines = 0.0;
    double ratios = 0.0;
    int pairs = 0;
    for (std::size_t i = 0; i < common.size(); ++i)
      for (std::size_t k = i + 1; k < common.size(); ++k) {
        const Point there = common[k].first - common[i].first;
        const Point here = common[k].second - common[i].second;
        if (there.norm() <= 0.0 || here.norm() <= 0.0) continue;
        const double turn = std::atan2(there.y(), there.x()) - std::atan2(here.y(), here.x());
        sines += std::sin(turn);
        cosines += std::cos(turn);
        ratios += here.norm() / there.norm();
        ++pairs;
      }
    if (pairs == 0) {
      warnings.push_back(level_.place.text() + ": the level " + in_quotes(name_) +
                         " has no two fiducials in common with the first: it lies where its own drawing puts it");
      const double own = measured_scale();
      transform.scale = own > 0.0 ? own : reference_scale;
      return transform;
    }
    transform.turn_rad = std::atan2(sines, cosines);
    transform.scale = reference_scale * pairs / ratios;
    Point shift{0.0, 0.0};
    for (const auto& [there, here] : common) shift += reference_scale * there - transform(here);
    transform.shift = shift / static_cast<double>(common.size());
    return transform;
  }

  // What a lane uses or what has a name.
  [[nodiscard]] Level level_by(const Transform& transform, Site& site) const {
    Level level{name_, {}, {}};
    std::vector<Lane> lanes;
    std::vector<bool> is_used(vertices_.size());
    for (const ConfigValue& value : list_in(level_, "lanes")) {
      Lane lane{vertex_index(value, 0, vertices_.size()), vertex_index(value, 1, vertices_.size()),
                properties_of(value, 2)};
      check_orientation(lane.properties, "orientation");
      check_orientation(lane.properties, "orientation_constraint");
      is_used[lane.from] = is_used[lane.to] = true;
      lanes.push_back(std::move(lane));
    }
    std::map<std::size_t, std::size_t> place;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (!is_used[i] && vertices_[i].name.empty()) continue;
      place[i] = level.vertices.size();
      level.vertices.push_back(vertices_[i]);
      level.vertices.back().at_m = placed(i, transform);
    }
    for (Lane& lane : lanes) take_lane(lane, place, level);
    if (const std::size_t unused = vertices_.size() - place.size(); unused > 0)
      site.warnings.push_back("level " + in_quotes(name_) + ": " + std::to_string(unused) +
                              (unused == 1 ? " vertex" : " vertices") +
                              " without name and lane, of walls and floors: no landmark");
    const std::size_t doors = list_in(level_, "doors").size();
    if (doors > 0) site.warnings.push_back("level " + in_quotes(name_) + ": " + counted(doors, "door") + ", not read");
    return level;
  }

 private:
  // Two vertices that are almost one give measurements by which all others lie anywhere.
  [[nodiscard]] Point placed(std::size_t i, const Transform& transform) const {
    Point at_m = transform(vertices_[i].at_m);
    if (!(std::abs(at_m.x()) <= kMaxCoordinate && std::abs(at_m.y()) <= kMaxCoordinate))
      throw ConfigError(list_in(level_, "vertices")[i].place,
                        "by the level's measurements and fiducials the vertex is more than 1000 km away");
    return at_m;
  }
  static Point point(const ConfigValue& value, double y_sign) {
    return {number(value.items[0], "x"), y_sign * number(value.items[1], "y")};
  }

  // As the traffic editor's own navigation graphs have them: two lanes for a bidirectional one, nothing that is empty.
  static void take_lane(Lane& lane, const std::map<std::size_t, std::size_t>& place, Level& level) {
    lane.from = place.at(lane.from);
    lane.to = place.at(lane.to);
    const bool is_both = is_true(lane.properties.find("bidirectional"));
    lane.properties.erase("bidirectional");
    std::erase_if(lane.properties.entries, [](const auto& entry) {
      return entry.second.kind == ConfigValue::Kind::scalar && entry.second.scalar.empty();
    });
    for (auto& [key, value] : lane.properties.entries)
      if (key == "orientation") key = "orientation_constraint";
    level.lanes.push_back(lane);
    if (!is_both) return;
    std::swap(lane.from, lane.to);
    for (auto& [key, value] : lane.properties.entries)
      if (key == "orientation_constraint") value.scalar = value.scalar == "forward" ? "backward" : "forward";
    level.lanes.push_back(lane);
  }

  const ConfigValue& level_;
  std::string name_;
  std::vector<Vertex> vertices_;
  std::vector<Fiducial> fiducials_;
};

bool is_in_pixels(const ConfigValue& root) {
  const ConfigValue* system = root.find("coordinate_system");
  if (system == nullptr) return true;
  const std::size_t choice = config_detail::to_choice(*system, "coordinate_system",
                                                      {"reference_image", "cartesian_meters", "web_mercator", "wgs84"});
  if (choice > 1)
    throw ConfigError(system->place,
                      "the coordinate system " + system->scalar + " is not of metres: a map needs metres");
  return choice == 0;
}

std::size_t reference_level(const ConfigValue& root, const ConfigValue& levels) {
  const ConfigValue* name = root.find("reference_level_name");
  if (name == nullptr) return 0;
  std::vector<std::string> names;
  for (const ConfigValue::Entry& entry : levels.entries) names.push_back(entry.key);
  return config_detail::to_choice(*name, "reference_level_name", names);
}

}  // namespace

Site site_of_building(const ConfigValue& root) {
  Site site;
  check_keys(root, kSiteKeys, "the building", site.warnings);
  const ConfigValue& levels = *root.find("levels");
  const bool in_pixels = is_in_pixels(root);
  std::vector<Drawing> drawings;
  for (const ConfigValue::Entry& entry : levels.entries) {
    check_keys(entry.value, kLevelKeys, "the level " + in_quotes(entry.key), site.warnings);
    drawings.emplace_back(entry.value, entry.key, in_pixels ? -1.0 : 1.0);
  }
  if (drawings.empty()) throw ConfigError(levels.place, "the building has no level");
  const Drawing& reference = drawings[reference_level(root, levels)];
  double scale = in_pixels ? reference.measured_scale() : 1.0;
  if (scale == 0.0) {
    site.warnings.push_back(levels.place.text() + ": no measurement says how long a pixel is; taken for 1 m");
    scale = 1.0;
  }
  for (const Drawing& drawing : drawings) {
    const bool is_plain = !in_pixels || &drawing == &reference;
    site.levels.push_back(drawing.level_by(
        is_plain ? Transform{scale, 0.0, {0.0, 0.0}} : drawing.onto(reference, scale, site.warnings), site));
  }
  const ConfigValue* name = root.find("building_name") != nullptr ? root.find("building_name") : root.find("name");
  if (name != nullptr) site.others.entries.emplace_back("building_name", *name);
  if (const ConfigValue* lifts = root.find("lifts"); lifts != nullptr && !lifts->entries.empty())
    site.warnings.push_back(counted(lifts->entries.size(), "lift") + ", not read: no route leads from floor to floor");
  return site;
}

}  // namespace cairn::rmf
