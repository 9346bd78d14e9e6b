#include "framework/mission/mission.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "framework/behaviour_tree/condition.hpp"
#include "framework/files/robot_file.hpp"
#include "framework/files/template_file.hpp"
#include "framework/files/world_file.hpp"
#include "maps/base/fingerprint.hpp"

namespace cairn {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The detector's settings hold keys of its own too: take those that the host knows.
TemplateSettings template_settings_of(const PluginChoice& detector) {
  ConfigValue mine;
  mine.kind = ConfigValue::Kind::map;
  mine.place = detector.config.place;
  for (const FieldSpec& field : schema_of<TemplateSettings>().fields)
    for (const ConfigValue::Entry& entry : detector.config.entries)
      if (entry.key == field.key) mine.entries.push_back(entry);
  auto settings = load_config<TemplateSettings>(mine, "detector");
  if (settings.sizes.empty()) throw ConfigError(mine.find("sizes")->place, "sizes must hold at least one size");
  return settings;
}

// A landmark that does not fit into the world cannot be found in it.
void check_sizes(const std::vector<LandmarkShape>& shapes, const World& world, const std::filesystem::path& folder) {
  const Point size_m = world.max_m - world.min_m;
  for (const LandmarkShape& shape : shapes) {
    const double diameter_m = shape.contour.outer_diameter_m();
    if (diameter_m <= size_m.maxCoeff() && shape.contour.inner_diameter_m() <= size_m.minCoeff()) continue;
    throw ConfigError(SourcePlace{folder.string(), 0, 0},
                      "the template " + in_quotes(shape.category) + " is " + config_detail::number_text(diameter_m) +
                          " m across, larger than the mission's world of " + config_detail::number_text(size_m.x()) +
                          " x " + config_detail::number_text(size_m.y()) + " m");
  }
}

// What is wrong beside them hides no category.
void take_marker_categories(const ConfigValue& root, Mission& mission, ConfigErrors& errors) {
  const ConfigValue* const markers = root.find("markers");
  const ConfigValue* const categories = markers == nullptr ? nullptr : markers->find("categories");
  if (categories == nullptr) return;
  mission.has_all_categories = false;
  errors.attempt([&] {
    mission.marker_categories = marker_categories_of(*categories);
    mission.has_all_categories = true;
  });
}

// A camera is what markers are seen by.
void check_cameras(const ConfigValue& root, const Mission& mission) {
  if (mission.config.markers && mission.robot.cameras.empty())
    throw ConfigError(root.find("markers")->place, "markers: the robot file has no `cameras` to see them by");
}

void check_recordings(const ConfigValue& root, const MissionConfig& config) {
  if (config.record_mcap.empty() || config.record_mcap != config.record) return;
  throw ConfigError(root.find("record_mcap")->place,
                    "record_mcap: " + in_quotes(config.record) + " is what `record` writes; each needs its own file");
}

// A plain name: an autosave never leaves the output folder.
void check_autosave(const ConfigValue& root, const std::string& mission, const std::string& file) {
  const auto refuse = [&](const std::string& why) {
    throw ConfigError(root.find("autosave")->find("file")->place, "autosave.file: " + in_quotes(file) + why);
  };
  if (file == "." || file == ".." || file.find_first_of("/\\") != std::string::npos)
    refuse(" is not a plain file name; maps are saved into the output folder");
  if (!file.empty() && !file.ends_with(".cairn")) refuse(" does not end in .cairn, as a saved map's name does");
  if (file == mission + ".cairn") refuse(" is the name of the map that the mission saves at its end");
}

// What the work reads of a file. A file that cannot be read at all is wrong where it is named; what is wrong within it
// has its place there.
template <class Work>
auto read_at(const ConfigValue& name, const std::string& key, const std::filesystem::path& file, const Work& work) {
  try {
    return work();
  } catch (const ConfigError& error) {
    if (error.place() != SourcePlace{file.string(), 0, 0}) throw;
    std::error_code unknown;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(std::filesystem::absolute(file), unknown);
    throw ConfigError(name.place, key + ": " + (unknown ? file : whole).string() + ": " + error.sentence());
  }
}

SourcePlace start_place_of(const ConfigValue& root) {
  const ConfigValue* const start = root.find("start");
  const ConfigValue* const at = start == nullptr ? nullptr : start->find("at_m");
  return at != nullptr ? at->place : start != nullptr ? start->place : root.place;
}

// What the mission's settings name. Whether all of it could be read.
bool read_files(const ConfigValue& root, Mission& mission, ConfigErrors& errors) {
  const std::size_t errors_before = errors.all().size();
  const MissionConfig& config = mission.config;
  if (!config.robot.empty())
    errors.attempt([&] {
      mission.robot = read_at(*root.find("robot"), "robot", config.robot, [&] { return load_robot(config.robot); });
    });
  bool has_shapes = false;
  errors.attempt([&] {
    if (!config.detector.name.empty()) use_detector(mission, config.detector);
    has_shapes = true;
  });
  if (!has_shapes || (config.detector.name.empty() && root.find("detector") != nullptr))
    mission.has_all_categories = false;
  const ConfigValue* const world = root.find("world");
  if (!config.world.empty())
    errors.attempt([&] {
      read_at(*world, "world", config.world, [&] {
        // Without the templates, what the world says of their landmarks cannot be read.
        if (!has_shapes) return (void)read_config_file(config.world);
        mission.world = load_world(config.world, mission.shapes);
      });
      if (!mission.world) return;
      mission.world_fingerprint = fingerprint_of(bytes_of(config.world));
      check_sizes(mission.shapes, *mission.world, mission.template_settings.templates);
    });
  const bool has_names = !config.robot.empty() && (world == nullptr || !config.world.empty());
  return has_names && !errors.is_full() && errors.all().size() == errors_before;
}

}  // namespace

void StartConfig::describe(Fields<StartConfig>& fields) {
  fields.point("at_m", &StartConfig::at_m, "m", "where the robot begins, in the map frame");
  fields.angle("angle_deg", &StartConfig::angle_rad, {-360.0, 360.0}, "heading there");
}

PluginChoice default_controller() {
  PluginChoice choice;
  choice.name = "pursuit_dwa";
  return choice;
}

PluginChoice default_loop_closer() {
  PluginChoice choice;
  choice.name = "submap_correlation";
  choice.config.kind = ConfigValue::Kind::map;
  return choice;
}

void MissionConfig::describe(Fields<MissionConfig>& fields) {
  using C = MissionConfig;
  fields.file_name("mission", &C::mission, "name of the mission").required = true;
  fields.integer("seed", &C::seed, {0.0, 9.0e15}, "of all randomness; the same seed gives the same bytes");
  fields.file("robot", &C::robot, "robot file").required = true;
  fields.file("world", &C::world, "world file; leave out when the sensor is a log");
  fields.group("start", &C::start, "where the robot begins; a log with poses may know better");
  fields.plugin("sensor", &C::sensor, "sensor", "source of observations").required = true;
  fields.plugin("localizer", &C::localizer, "localizer", "where the robot is").required = true;
  fields.plugin("loop_closer", &C::loop_closer, "loop_closer",
                "proposes where places were passed before, to localizers that close loops");
  fields.plugin("map", &C::map, "map", "builds the occupancy grid").required = true;
  fields.plugin("detector", &C::detector, "detector", "recognises landmarks");
  fields.group("markers", &C::markers,
               "printed tags that cameras see become landmarks; without it no picture is taken");
  fields.plugin("planner", &C::planner, "planner", "plans paths from place to place");
  fields.plugin("controller", &C::controller, "controller", "follows paths past obstacles");
  fields.group("landmarks", &C::landmarks, "how detections become landmarks and routes");
  fields.group("clusters", &C::clusters, "how landmarks are put together to clusters, such as the rooms of a building");
  fields.group("collision_monitor", &C::collision_monitor, "what keeps the robot from driving into what it sees");
  fields.number("at_most_s", &C::at_most_s, {0.0, 1e7}, "s",
                "the mission ends then, whatever it is doing; the time of runs that this one continues counts");
  fields.number(
      "watchdog_s", &C::watchdog_s, {0.0, 1e6}, "s",
      "a module whose call has not returned after this (wall clock) is given up and ends the mission, as one that has "
      "not been made after this (10 s at least) does before it; 0: never");
  fields.file_name("record", &C::record,
                   "file in the output folder that gets all observations as a CARMEN log, to be played back by "
                   "carmen_log; packed by gzip where it ends in .gz. Empty: MISSION.log.gz, or MISSION.2.log.gz where "
                   "that is there, when a robot is driven and the mission has no world; else none. none: none");
  fields.file_name("record_mcap", &C::record_mcap,
                   "file in the output folder that gets the run as an MCAP recording, for Foxglove, Rerun and ROS 2");
  fields.integer("hold_out_every", &C::hold_out_every, {0.0, 1e6},
                 "every n-th range reading is held out of the map, so that an experiment can measure how well the "
                 "map predicts it; 0: none");
  fields.flag(
      "check_pose_under_way", &C::check_pose_under_way,
      "a robot whose readings contradict its map checks whether it was carried; false: it believes its place, and "
      "no copies of the map are kept for that");
  fields.group("autosave", &C::autosave, "the map is saved while the mission runs, for `cairn run --resume`");
  fields.group("history", &C::history, "how much is remembered of a long mission");
  fields.raw("steps", &C::steps, "list of steps",
             "behaviours and other nodes one after the other, each `{name: settings}`: docs/missions.md");
}

std::string autosave_file_of(const MissionConfig& config) {
  return config.autosave.file.empty() ? config.mission + ".autosave.cairn" : config.autosave.file;
}

std::vector<std::string> categories_of(const Mission& mission) {
  std::vector<std::string> categories;
  if (!mission.has_all_categories) return categories;
  categories.reserve(mission.shapes.size() + mission.marker_categories.size());
  for (const LandmarkShape& shape : mission.shapes) categories.push_back(shape.category);
  for (const auto& [number, category] : mission.marker_categories)
    if (std::ranges::find(categories, category) == categories.end()) categories.push_back(category);
  return categories;
}

void use_detector(Mission& mission, const PluginChoice& detector) {
  mission.config.detector = detector;
  mission.template_settings = template_settings_of(mission.config.detector);
  mission.shapes.clear();
  const std::filesystem::path& folder = mission.template_settings.templates;
  if (folder.empty()) return;
  const ConfigValue& settings = mission.config.detector.config;
  const ConfigValue* const named = settings.find("templates");
  mission.shapes =
      read_at(named == nullptr ? settings : *named, "templates", folder, [&] { return load_landmark_shapes(folder); });
}

ReadMission read_mission(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                         std::optional<std::int64_t> seed) {
  ConfigValue root = read_config_file(file);
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  ReadMission read;
  Mission& mission = read.mission;
  ConfigErrors errors;
  errors.attempt([&] { schema_of<MissionConfig>().load_into(&mission.config, root, "mission"); });
  errors.attempt([&] { check_autosave(root, mission.config.mission, mission.config.autosave.file); });
  errors.attempt([&] { check_recordings(root, mission.config); });
  if (seed) mission.config.seed = *seed;
  mission.start_place = start_place_of(root);
  take_marker_categories(root, mission, errors);
  read.has_files = read_files(root, mission, errors);
  if (read.has_files) errors.attempt([&] { check_cameras(root, mission); });
  read.errors = errors.all();
  MissionTree tree = read_mission_tree(mission.config.steps, file);
  mission.steps = std::move(tree.steps);
  read.step_errors = std::move(tree.errors);
  std::ranges::move(unknown_categories(mission.steps, categories_of(mission)), std::back_inserter(read.step_errors));
  return read;
}

Mission load_mission(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                     std::optional<std::int64_t> seed) {
  ReadMission read = read_mission(file, overrides, seed);
  if (!read.errors.empty()) throw read.errors.front();
  if (!read.step_errors.empty()) throw read.step_errors.front();
  return std::move(read.mission);
}

}  // namespace cairn
