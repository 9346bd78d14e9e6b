// A mission as its file describes it (config/missions/*.yaml), checked but not yet built.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/behaviour_tree/tree.hpp"
#include "framework/config/fields.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"
#include "framework/files/template_settings.hpp"
#include "framework/landmarks/markers/marker_config.hpp"
#include "framework/landmarks/tracker.hpp"
#include "framework/mission/autosave.hpp"
#include "framework/mission/history.hpp"
#include "framework/planning/clusters_config.hpp"
#include "framework/safety/config.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn {

struct StartConfig {
  Point at_m{0.0, 0.0};
  double angle_rad = 0.0;
  static void describe(Fields<StartConfig>& fields);
};

// `pursuit_dwa` with its default settings.
[[nodiscard]] PluginChoice default_controller();
// `submap_correlation` with its default settings.
[[nodiscard]] PluginChoice default_loop_closer();

struct MissionConfig {
  std::string mission;
  std::int64_t seed = 1;
  std::filesystem::path robot;
  std::filesystem::path world;
  StartConfig start;
  PluginChoice sensor;
  PluginChoice localizer;
  PluginChoice loop_closer = default_loop_closer();
  PluginChoice map;
  PluginChoice detector;
  PluginChoice planner;
  PluginChoice controller = default_controller();
  std::optional<MarkersConfig> markers;
  LandmarksConfig landmarks;
  ClustersConfig clusters;
  CollisionMonitorConfig collision_monitor;
  double at_most_s = 36000.0;
  double watchdog_s = 30.0;
  std::string record;
  std::string record_mcap;
  int hold_out_every = 0;
  bool check_pose_under_way = true;
  AutosaveConfig autosave;
  HistoryConfig history;
  ConfigValue steps;
  static void describe(Fields<MissionConfig>& fields);
};

struct Mission {
  MissionConfig config;
  TemplateSettings template_settings;  // as the detector's own say
  RobotModel robot;
  std::optional<World> world;
  std::string world_fingerprint;  // of its file; empty without one
  SourcePlace start_place;        // of `start`, or of the file that lacks it
  std::vector<LandmarkShape> shapes;
  std::map<int, std::string> marker_categories;  // by the numbers of markers
  bool has_all_categories = true;                // of shapes and markers; false: a mistake in a file hides some
  std::vector<TreeNode> steps;
};

// Of landmarks that the mission can find: of its shapes and its markers. Empty: not known.
[[nodiscard]] std::vector<std::string> categories_of(const Mission& mission);

// Name of the autosaved map in the output folder.
[[nodiscard]] std::string autosave_file_of(const MissionConfig& config);

// Takes the detector and loads its templates. Throws ConfigError.
void use_detector(Mission& mission, const PluginChoice& detector);

// Throws ConfigError. overrides: "key=value" texts of --set; seed wins over the file's.
[[nodiscard]] Mission load_mission(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                                   std::optional<std::int64_t> seed = std::nullopt);

struct ReadMission {
  Mission mission;                  // without what could not be read
  bool has_files = false;           // robot, world and templates: modules can be made
  std::vector<ConfigError> errors;  // of its settings and of the files that it names; load_mission throws the first
  std::vector<ConfigError> step_errors;  // then the first of these
};
// All that is wrong, not only the first. Throws ConfigError when the file itself cannot be read.
[[nodiscard]] ReadMission read_mission(const std::filesystem::path& file,
                                       const std::vector<std::string>& overrides = {},
                                       std::optional<std::int64_t> seed = std::nullopt);

}  // namespace cairn
