// The commands of `cairn`, each a function from its options to an exit status: 0 done, 1 the mission
// or plan did not succeed, 2 wrong usage or a bad file (thrown as std::exception, reported by main).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/plan_question.hpp"
#include "framework/planning/saved_map/map_planner_options.hpp"

namespace cairn {

inline constexpr int kExitDone = 0;
inline constexpr int kExitNotSolved = 1;
inline constexpr int kExitBadInput = 2;

struct Mission;

struct CommonOptions {
  std::vector<std::filesystem::path> plugin_folders;
  bool json = false;
};

struct RunCommand {
  std::filesystem::path mission;
  std::filesystem::path out = "out";
  std::filesystem::path resume;       // a saved map to go on from; empty: from the beginning
  std::filesystem::path localise_in;  // a saved map that is left alone; empty: none
  std::string pose;                   // "x,y,degrees" in it, or in that to resume; empty: not known
  std::optional<std::int64_t> seed;
  std::vector<std::string> overrides;
  double pace = 0.0;             // seconds of the mission a second, at most; 0: as fast as the machine
  std::filesystem::path orders;  // recorded orders that are given again; empty: none
  bool other_world = false;      // go on although the map was made in another one
  bool view = false;             // with a viewer beside it
  bool control = false;          // which may steer
};
int run(const RunCommand& command, const CommonOptions& common);

struct BaseCommand {
  std::filesystem::path mission;
  std::string listen;  // path of a socket, or localhost:PORT
  double pace = 1.0;   // 0: an observation each time that the client asks
  std::filesystem::path log;
  std::optional<std::int64_t> seed;
  std::vector<std::string> overrides;
};
int base(const BaseCommand& command, const CommonOptions& common);

struct DoctorLiveCommand {
  std::filesystem::path mission;
  double for_s = 5.0;
  bool wiggle = false;
  std::vector<std::string> overrides;
};
int doctor_live(const DoctorLiveCommand& command, const CommonOptions& common);

struct SlamEvalCommand {
  std::filesystem::path relations;
  std::filesystem::path poses;
  double tolerance_s = 0.001;  // between a stamp of a relation and that of a pose
};
int slam_eval(const SlamEvalCommand& command, const CommonOptions& common);

struct SlamSolveCommand {
  std::filesystem::path graph;
  std::filesystem::path out;  // empty: none
  bool robust = false;
};
int slam_solve(const SlamSolveCommand& command, const CommonOptions& common);

struct MissionCheckCommand {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> overrides;
};
// 2 when there is an error in any of the files; all that are found are reported.
int mission_check(const MissionCheckCommand& command, const CommonOptions& common);

struct MissionShowCommand {
  std::filesystem::path file;
  std::vector<std::string> overrides;
  std::filesystem::path picture;  // empty: none
};
int mission_show(const MissionShowCommand& command, const CommonOptions& common);

struct MissionControlCommand {
  std::filesystem::path out;  // of the run
  std::string command;        // pause, resume, cancel or order
  std::string order{};        // as JSON
};
// 1 when it has not come about; throws when no mission runs there.
int mission_control(const MissionControlCommand& command, const CommonOptions& common);
int mission_status(const MissionControlCommand& command, const CommonOptions& common);

struct PlanCommand : MapPlannerOptions {
  PlanQuestion question;
  std::string queries;      // a file, "-" for standard input, empty for one query
  std::optional<int> jobs;  // queries at once; none: as many as there are cores
  std::string serve;        // an address at which questions are answered until Ctrl-C; empty: none
  std::filesystem::path picture;
};
int plan(const PlanCommand& command, const CommonOptions& common);

struct ViewCommand {
  std::filesystem::path map;  // or the output folder of a run
  std::uint16_t port = 0;     // 0: a free one
  bool control = false;       // the page may pause, resume, cancel and order
  bool edit = false;          // the page may change the map
  std::string planner = "hybrid";
  double budget_ms = 10000.0;                // of a plan
  std::vector<std::string> allowed_origins;  // of pages elsewhere whose viewers may connect
};
// Serves the map or the run to browsers of this machine until Ctrl-C.
int view(const ViewCommand& command, const CommonOptions& common);

struct MapCommand {
  std::filesystem::path map;
  std::filesystem::path picture;  // empty: map.png, unless there is one
  std::filesystem::path repaired;
};
int map_info(const MapCommand& command, const CommonOptions& common);
// 2 when the map is damaged: what is lost is reported.
int map_check(const MapCommand& command, const CommonOptions& common);
// Writes what the map still holds to another file.
int map_repair(const MapCommand& command, const CommonOptions& common);
int map_render(const MapCommand& command, const CommonOptions& common);

struct ExchangeCommand {
  std::filesystem::path from;         // the file of another tool, or the map
  std::filesystem::path to;           // the other way round
  std::optional<double> cell_m;       // of a picture that does not say it
  std::string mode;                   // of a map_server file: trinary, scale, raw; empty: trinary
  std::string picture;                // of a map_server file: pgm, png, bmp; empty: what suits the mode
  std::optional<double> px_per_cell;  // of a plain picture
  std::vector<std::string> clusters;  // key=value, as under `clusters` of a mission
  bool allow_outside = false;         // a picture may be outside the folder of the file that names it
};
int map_import(const ExchangeCommand& command, const CommonOptions& common);
int map_export(const ExchangeCommand& command, const CommonOptions& common);

inline constexpr double kMaxCoordinate = 1e6;  // of a box or a transform, in metres or degrees

struct MergeCommand {
  std::filesystem::path a;
  std::filesystem::path b;
  std::optional<std::string> transform;  // x,y,deg: where b's frame lies in a's; none: it is found out
  double near_m = 0.4;                   // landmarks of one category this near to each other are one
  std::filesystem::path out;
};
int map_merge(const MergeCommand& command, const CommonOptions& common);

struct CropCommand {
  std::filesystem::path map;
  std::string box;  // x0,y0,x1,y1: two opposite corners
  std::filesystem::path out;
};
int map_crop(const CropCommand& command, const CommonOptions& common);

struct DiffCommand {
  std::filesystem::path a;
  std::filesystem::path b;
  double near_m = 0.4;
  std::filesystem::path picture;  // empty: none
};
// 0 the same, 1 different.
int map_diff(const DiffCommand& command, const CommonOptions& common);

struct NameCommand {
  std::filesystem::path map;
  std::string what;  // a landmark or cluster
  std::string name;  // empty: takes its name away
};
int map_name(const NameCommand& command, const CommonOptions& common);

struct CloseCommand {
  std::filesystem::path map;
  std::vector<std::string> routes;  // 12 or R12
  bool both_ways = false;           // and the routes that lead back between the same landmarks
};
// Changes the map in place: closed routes are not taken by any plan until they are opened.
int map_close(const CloseCommand& command, const CommonOptions& common);
int map_open(const CloseCommand& command, const CommonOptions& common);

struct LintCommand {
  std::filesystem::path map;
  std::optional<double> radius_m;  // of the robot; none: the one saved in the map
  double near_m = 0.4;             // landmarks of one category this near to each other are taken for one
};
// 0 also when there are notes only, 1 when there are warnings or errors.
int map_lint(const LintCommand& command, const CommonOptions& common);

struct TemplateCommand {
  std::filesystem::path folder;
  std::filesystem::path robot;  // for `sensed` templates
  std::string rendering = "sensed";
  double cell_m = 0.05;
  double step_deg = 15.0;
  std::filesystem::path picture{};  // empty: templates.png, unless there is one
};
// Rendered as a mission with this robot would have them; what: of the command, for an error.
[[nodiscard]] Mission template_mission(const TemplateCommand& command, const std::string& what);
int template_list(const TemplateCommand& command, const CommonOptions& common);
int template_preview(const TemplateCommand& command, const CommonOptions& common);
// 1 when a category is taken for another.
int template_check(const TemplateCommand& command, const CommonOptions& common);

struct CaptureCommand {
  std::filesystem::path map;
  std::string at;  // a place
  std::string category;
  double radius_m = 0.8;
  std::filesystem::path out;
};
int template_capture(const CaptureCommand& command, const CommonOptions& common);

struct ChartCommand {
  std::filesystem::path file;        // Markdown
  std::vector<std::string> columns;  // to draw; none: all of numbers
  std::string title;                 // {} stands for the section's heading; empty: the heading
  std::string y_label;
  bool of_shares = false;  // y from 0 to 1
  std::filesystem::path out = "out";
  std::string prefix;  // of the pictures' names
};
// One picture a table.
int chart(const ChartCommand& command, const CommonOptions& common);

struct PluginsCommand {
  std::string name;
  std::string group;  // of its settings, as driving.look; empty: the module itself
  bool all = false;   // with what stands in groups
};
int plugins_list(const CommonOptions& common);
int plugins_info(const PluginsCommand& command, const CommonOptions& common);

struct PluginsCheckCommand {
  std::vector<std::filesystem::path> files;  // none: all in the plugin folders
};
// 1 when one of them cannot be used.
int plugins_check(const PluginsCheckCommand& command, const CommonOptions& common);

struct NewPluginCommand {
  std::string kind;
  std::string name;
  std::filesystem::path folder;  // of the new project; empty: the module's name
};
int plugins_new(const NewPluginCommand& command, const CommonOptions& common);

struct ReferenceCommand {
  std::filesystem::path markdown;       // empty, and no folder either: to standard output
  std::filesystem::path schema_folder;  // gets mission.schema.json and the like
};
int plugins_reference(const ReferenceCommand& command, const CommonOptions& common);

struct ExperimentCommand {
  std::filesystem::path file;
  std::filesystem::path out = "out/experiment";
  std::vector<std::string> overrides{};
  std::string shard{};  // "K/N": only these runs, and no table; empty: all
  bool merge = false;   // nothing is run: the table of what shards have run
};
int experiment(const ExperimentCommand& command, const CommonOptions& common);

}  // namespace cairn
