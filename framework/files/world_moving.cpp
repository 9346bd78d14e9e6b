#include "framework/files/world_moving.hpp"

#include <algorithm>
#include <stdexcept>

namespace cairn::world_config {
namespace {

TimeSpan time_span_of(const ConfigValue& value) {
  const std::vector<double> ends = config_detail::to_numbers(value, "closed_s", {0.0, 1e9});
  if (ends.size() != 2)
    throw ConfigError(value.place, "each item of closed_s must be two times [begin, end], found a list of " +
                                       std::to_string(ends.size()));
  if (ends[0] >= ends[1])
    throw ConfigError(value.place,
                      "a door's time closed must end after it begins, found " + point_text({ends[0], ends[1]}));
  return {ends[0], ends[1]};
}

std::vector<TimeSpan> time_spans_of(const ConfigValue& list) {
  std::vector<TimeSpan> spans;
  for (const ConfigValue& item : config_detail::to_list(list, "closed_s")) {
    const TimeSpan span = time_span_of(item);
    if (!spans.empty() && span.begin_s < spans.back().end_s)
      throw ConfigError(item.place,
                        "a door's times closed must follow each other: " + point_text({span.begin_s, span.end_s}) +
                            " begins before " + point_text({spans.back().begin_s, spans.back().end_s}) + " ends");
    spans.push_back(span);
  }
  return spans;
}

void check_path(const World& world, const MoverConfig& config, const ConfigValue& path) {
  const std::vector<Point>& points_m = config.path_m;
  if (points_m.size() < 2)
    throw ConfigError(path.place, "a path needs at least 2 points, found " + std::to_string(points_m.size()));
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    check_inside(world, points_m[i], path.items[i].place, "the path's point");
    if (i > 0 && (points_m[i] - points_m[i - 1]).norm() < 1e-3)
      throw ConfigError(path.items[i].place, "a path's point stands here twice: " + point_text(points_m[i]));
  }
  if (config.course == Course::round && (points_m.front() - points_m.back()).norm() < 1e-3)
    throw ConfigError(path.items.back().place,
                      "a round goes back to the path's first point by itself; it need not stand at the end again");
}

}  // namespace

std::vector<std::pair<std::string, Surface>> surfaces() {
  return {{"smooth", Surface::smooth}, {"rough", Surface::rough}};
}

std::string point_text(const Point& p) {
  return "[" + config_detail::number_text(p.x()) + ", " + config_detail::number_text(p.y()) + "]";
}

void check_inside(const World& world, const Point& p, const SourcePlace& place, const std::string& what) {
  if (p.x() >= world.min_m.x() && p.y() >= world.min_m.y() && p.x() <= world.max_m.x() && p.y() <= world.max_m.y()) {
    return;
  }
  throw ConfigError(place, what + " " + point_text(p) + " lies outside bounds_m " + point_text(world.min_m) + " to " +
                               point_text(world.max_m));
}

void ClosesConfig::describe(Fields<ClosesConfig>& fields) {
  fields.number("every_s", &ClosesConfig::every_s, {0.1, 1e6}, "s", "time from one closing to the next").required =
      true;
  fields.number("for_s", &ClosesConfig::for_s, {0.0, 1e6}, "s", "how long it is closed; less than every_s").required =
      true;
  fields.number("first_s", &ClosesConfig::first_s, {0.0, 1e6}, "s", "when it closes first");
}

void DoorConfig::describe(Fields<DoorConfig>& fields) {
  fields.text("name", &DoorConfig::name, "what it is called; no other door or mover is called so");
  fields.point("from_m", &DoorConfig::from_m, "m", "one end of the leaf").required = true;
  fields.point("to_m", &DoorConfig::to_m, "m", "its other end").required = true;
  fields.choice("surface", &DoorConfig::surface, surfaces(), "a smooth leaf bounces slanting beams away");
  fields.raw("closed_s", &DoorConfig::closed_s, "list of [begin, end]",
             "when it is closed, in seconds of simulated time; an empty list is a door that stays open");
  fields.group("closes", &DoorConfig::closes, "closes again and again");
  fields.one_of({"closed_s", "closes"});
}

void MoverConfig::describe(Fields<MoverConfig>& fields) {
  using C = MoverConfig;
  fields.text("name", &C::name, "what it is called; no other door or mover is called so");
  fields.number("circle_diameter_m", &C::circle_diameter_m, {0.01, 10.0}, "m", "a round outline: a person's legs");
  fields.points("polygon_m", &C::polygon_m, "m", "an outline's corners, about their centroid; it does not turn");
  fields.points("path_m", &C::path_m, "m", "the points that its centre goes to, one after the other").required = true;
  fields.number("speed_mps", &C::speed_mps, {0.01, 10.0}, "m/s", "how fast it goes");
  fields.number("pause_s", &C::pause_s, {0.0, 1e6}, "s", "how long it stands at each point");
  fields.choice("course", &C::course,
                {{"there_and_back", Course::there_and_back}, {"round", Course::round}, {"once", Course::once}},
                "back along the path from its end; from its end to its beginning; or it stays at the end");
  fields.number("start_s", &C::start_s, {0.0, 1e6}, "s", "until then it stands at the first point");
  fields.choice("surface", &C::surface, surfaces(), "smooth sides bounce slanting beams away");
  fields.flag("waits", &C::waits,
              "whether it stops short of the robot until that is gone; if not, it stops when it touches it");
  fields.number("keeps_m", &C::keeps_m, {0.01, 10.0}, "m", "how far from the robot it stops, when it waits");
  fields.one_of({"circle_diameter_m", "polygon_m"});
}

WorldDoor door_of(const World& world, const DoorConfig& config, const ConfigValue& value) {
  const std::string times = config_detail::exactly_one_of(value, schema_of<DoorConfig>().one_of, "a door");
  for (const auto& [key, end_m] : {std::pair{"from_m", config.from_m}, {"to_m", config.to_m}})
    check_inside(world, end_m, value.find(key)->place, key);
  if ((config.to_m - config.from_m).norm() < 0.01)
    throw ConfigError(value.find("to_m")->place, "a door needs a length: from_m and to_m are the same place");
  WorldDoor door{config.name, config.from_m, config.to_m, config.surface, {}};
  if (times == "closed_s") {
    door.closed_s = time_spans_of(config.closed_s);
    return door;
  }
  if (config.closes->for_s >= config.closes->every_s)
    throw ConfigError(value.find("closes")->place, "a door that closes every " +
                                                       config_detail::number_text(config.closes->every_s) +
                                                       " s must be closed for less than that, found " +
                                                       config_detail::number_text(config.closes->for_s) + " s");
  door.every_s = config.closes->every_s;
  door.closed_for_s = config.closes->for_s;
  door.first_s = config.closes->first_s;
  return door;
}

WorldMover mover_of(const World& world, const MoverConfig& config, const ConfigValue& value) {
  const std::string outline = config_detail::exactly_one_of(value, schema_of<MoverConfig>().one_of, "a mover");
  check_path(world, config, *value.find("path_m"));
  if (const ConfigValue* keeps = value.find("keeps_m"); keeps != nullptr && !config.waits)
    throw ConfigError(keeps->place, "keeps_m goes with waits: true; what does not wait stops when it touches");
  WorldMover mover{
      config.name,    {},           config.path_m, config.speed_mps, config.pause_s, config.course, config.start_s,
      config.surface, config.waits, config.keeps_m};
  try {
    mover.contour =
        outline == "polygon_m" ? Contour::polygon(config.polygon_m) : Contour::circle(config.circle_diameter_m);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(value.find(outline)->place, outline + ": " + error.what());
  }
  return mover;
}

void check_names(const ConfigValue& root) {
  std::vector<std::string> names;
  for (const char* list : {"doors", "movers"}) {
    if (root.find(list) == nullptr) continue;
    for (const ConfigValue& item : root.find(list)->items) {
      const ConfigValue* name = item.find("name");
      if (name == nullptr || name->scalar.empty()) continue;
      if (std::ranges::find(names, name->scalar) != names.end())
        throw ConfigError(name->place, "two doors or movers are called " + in_quotes(name->scalar));
      names.push_back(name->scalar);
    }
  }
}

}  // namespace cairn::world_config
