#include "framework/files/world_file.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "framework/config/fields.hpp"
#include "framework/files/world_moving.hpp"
#include "framework/files/world_tags.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

using namespace world_config;

struct WallConfig {
  std::vector<Point> points_m;
  Surface surface = Surface::smooth;
  static void describe(Fields<WallConfig>& fields) {
    fields.points("points_m", &WallConfig::points_m, "m", "the corners along the wall").required = true;
    fields.choice("surface", &WallConfig::surface, surfaces(), "smooth walls bounce slanting beams away");
  }
};

struct ObjectConfig {
  std::string template_category;
  double scale = 1.0;
  double circle_diameter_m = 0.0;
  std::vector<Point> polygon_m;
  std::optional<Point> at_m;
  std::optional<double> angle_rad;
  Surface surface = Surface::rough;
  static void describe(Fields<ObjectConfig>& fields) {
    fields.text("template", &ObjectConfig::template_category, "a landmark of this category");
    fields.number("scale", &ObjectConfig::scale, {0.1, 10.0}, "", "how large it is against its template");
    fields.number("circle_diameter_m", &ObjectConfig::circle_diameter_m, {0.01, 100.0}, "m", "a round obstacle");
    fields.points("polygon_m", &ObjectConfig::polygon_m, "m",
                  "an obstacle's corners: in the map without at_m, about their centroid with it");
    fields.point("at_m", &ObjectConfig::at_m, "m", "where its centre is");
    fields.angle("angle_deg", &ObjectConfig::angle_rad, {-360.0, 360.0}, "how it is turned, anticlockwise");
    fields.choice("surface", &ObjectConfig::surface, surfaces(), "smooth sides bounce slanting beams away");
    fields.one_of({"template", "circle_diameter_m", "polygon_m"});
  }
};

struct WorldConfig {
  std::vector<Point> bounds_m;
  std::vector<WallConfig> walls;
  std::vector<ObjectConfig> objects;
  std::vector<DoorConfig> doors;
  std::vector<MoverConfig> movers;
  std::vector<TagConfig> tags;
  static void describe(Fields<WorldConfig>& fields) {
    fields.points("bounds_m", &WorldConfig::bounds_m, "m", "lower left and upper right corner of the world").required =
        true;
    fields.list("walls", &WorldConfig::walls, "thin walls");
    fields.list("objects", &WorldConfig::objects, "landmarks and obstacles");
    fields.list("doors", &WorldConfig::doors, "sliding leaves; one never closes on the robot");
    fields.list("movers", &WorldConfig::movers, "people and carts; they mind nothing but the robot");
    fields.list("tags", &WorldConfig::tags, "printed markers, which cameras see");
  }
};

void set_bounds(World& world, const WorldConfig& config, const ConfigValue& root) {
  const SourcePlace& place = root.find("bounds_m")->place;
  if (config.bounds_m.size() != 2) {
    throw ConfigError(place,
                      "bounds_m must be two points [[x, y], [x, y]], found " + std::to_string(config.bounds_m.size()));
  }
  world.min_m = config.bounds_m[0];
  world.max_m = config.bounds_m[1];
  if (world.min_m.x() < world.max_m.x() && world.min_m.y() < world.max_m.y()) return;
  throw ConfigError(place, "bounds_m must go from the lower left to the upper right corner, found " +
                               point_text(world.min_m) + " to " + point_text(world.max_m));
}

WorldWall wall_of(const World& world, const WallConfig& config, const ConfigValue& value) {
  const ConfigValue& points = *value.find("points_m");
  if (config.points_m.size() < 2) {
    throw ConfigError(points.place, "a wall needs at least 2 points, found " + std::to_string(config.points_m.size()));
  }
  for (std::size_t i = 0; i < config.points_m.size(); ++i) {
    check_inside(world, config.points_m[i], points.items[i].place, "the wall's point");
    if (i > 0 && config.points_m[i] == config.points_m[i - 1]) {
      throw ConfigError(points.items[i].place, "a wall's point stands here twice: " + point_text(config.points_m[i]));
    }
  }
  return {config.points_m, config.surface};
}

Contour contour_of_category(const std::string& category, const SourcePlace& place,
                            const std::vector<LandmarkShape>& shapes) {
  const auto shape = std::ranges::find(shapes, category, &LandmarkShape::category);
  if (shape != shapes.end()) return shape->contour;
  std::vector<std::string> known;
  known.reserve(shapes.size());
  for (const LandmarkShape& s : shapes) known.push_back(s.category);
  throw ConfigError(place, "no template of the category " + in_quotes(category) + did_you_mean(category, known) +
                               "; known: " + (known.empty() ? "none" : joined(known)));
}

Contour contour_of(const ObjectConfig& config, const std::string& outline, const ConfigValue& value,
                   const std::vector<LandmarkShape>& shapes) {
  const SourcePlace& place = value.find(outline)->place;
  if (outline == "template") return contour_of_category(config.template_category, place, shapes).scaled(config.scale);
  if (const ConfigValue* scale = value.find("scale"))
    throw ConfigError(scale->place, "scale goes with template; " + outline + " says how large the object is");
  try {
    if (outline == "circle_diameter_m") return Contour::circle(config.circle_diameter_m);
    return config.at_m ? Contour::polygon(config.polygon_m) : Contour::polygon_in_place(config.polygon_m);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(place, outline + ": " + error.what());
  }
}

WorldObject object_of(const World& world, const ObjectConfig& config, const ConfigValue& value,
                      const std::vector<LandmarkShape>& shapes) {
  const std::string outline = config_detail::exactly_one_of(value, schema_of<ObjectConfig>().one_of, "an object");
  WorldObject object;
  object.category = config.template_category;
  object.contour = contour_of(config, outline, value, shapes);
  object.surface = config.surface;
  if (config.at_m) {
    check_inside(world, *config.at_m, value.find("at_m")->place, "at_m");
    object.T_map_object = {config.at_m->x(), config.at_m->y(), wrap_angle(config.angle_rad.value_or(0.0))};
    return object;
  }
  if (outline != "polygon_m") throw ConfigError(value.place, "an object with " + outline + " needs at_m");
  if (config.angle_rad) throw ConfigError(value.find("angle_deg")->place, "angle_deg needs at_m, the point to turn on");
  const std::vector<ConfigValue>& corners = value.find("polygon_m")->items;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    check_inside(world, config.polygon_m[i], corners[i].place, "the corner");
  }
  return object;
}

}  // namespace

Schema world_file_schema() {
  return schema_of<WorldConfig>();
}

World load_world(const std::filesystem::path& file, const std::vector<LandmarkShape>& shapes) {
  const ConfigValue root = read_config_file(file);
  const auto config = load_config<WorldConfig>(root, "world");
  World world;
  set_bounds(world, config, root);
  for (std::size_t i = 0; i < config.walls.size(); ++i) {
    world.walls.push_back(wall_of(world, config.walls[i], root.find("walls")->items[i]));
  }
  for (std::size_t i = 0; i < config.objects.size(); ++i) {
    world.objects.push_back(object_of(world, config.objects[i], root.find("objects")->items[i], shapes));
  }
  for (std::size_t i = 0; i < config.doors.size(); ++i)
    world.doors.push_back(door_of(world, config.doors[i], root.find("doors")->items[i]));
  for (std::size_t i = 0; i < config.movers.size(); ++i)
    world.movers.push_back(mover_of(world, config.movers[i], root.find("movers")->items[i]));
  for (std::size_t i = 0; i < config.tags.size(); ++i)
    world.tags.push_back(tag_of(world, config.tags[i], root.find("tags")->items[i]));
  check_names(root);
  return world;
}

}  // namespace cairn
