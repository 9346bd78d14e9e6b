// The `cairn` program: reads the command line and hands over to the commands.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/config/config_value.hpp"
#include "framework/contracts/abi_stamp.hpp"
#include "framework/modules/trial/child_trial.hpp"
#include "framework/program/common/command_line.hpp"
#include "framework/program/common/mission_options.hpp"
#include "framework/program/common/printable_stream.hpp"
#include "framework/program/map/file_options.hpp"
#include "framework/program/slam/slam_options.hpp"
#include "framework/program/view/view_options.hpp"
#include "framework/safety/fatal_ends.hpp"

namespace cairn {
namespace {

constexpr const char* kPictureToWrite = "picture to write, in place of an older one; without it, ";

CLI::Range seed_range() {
  return {std::int64_t{0}, std::int64_t{9000000000000000}};
}

void add_run(CLI::App& app, CommandLine& line) {
  const auto [sub, c] = add_command(app, line, run, "run", "Run a mission: map, recognise, plan and drive");
  sub->add_option("MISSION", c->mission, "mission file (config/missions/*.yaml)")->required();
  sub->add_option("--out", c->out, "folder for map, pictures and report")->capture_default_str();
  sub->add_option("--seed", c->seed, "seed, in place of the mission's")->check(seed_range());
  add_repeatable(sub, "--set", c->overrides, "override a setting: --set map.cell_m=0.1 (may be repeated)");
  CLI::Option* const resume =
      sub->add_option("--resume", c->resume, "saved or autosaved map of this mission (*.cairn) to continue");
  CLI::Option* const localise_in =
      sub->add_option("--localize-in", c->localise_in,
                      "saved map (*.cairn) in which the robot finds out where it is; it is left alone");
  localise_in->excludes(resume);
  sub->add_option("--pose", c->pose, "where the robot is in either map: X,Y,DEGREES");
  sub->add_flag("--other-world", c->other_world, "go on although the map was made in another world");
  sub->add_option("--orders", c->orders, "orders of an earlier run (orders.jsonl) to give again, each with its tick");
  CLI::Option* const view = sub->add_flag("--view", c->view, "watch in a browser: prints the address");
  sub->add_flag("--control", c->control, "let the page pause, resume and cancel, and give orders")->needs(view);
  add_pace(sub, c->pace);
}

void add_base(CLI::App& app, CommandLine& line) {
  const auto [sub, c] = add_command(app, line, base, "base", "Serve a mission's robot and world as a base of its own");
  sub->add_option("MISSION", c->mission, "mission file whose robot, world and sensor are served")->required();
  sub->add_option("--listen", c->listen, "path of a socket, or localhost:PORT")->required();
  add_number(sub, "--pace", c->pace, "simulated seconds a second; 0: an observation each time that the client asks",
             0.0, 1000.0);
  sub->add_option("--log", c->log, "file for one line a tick: what was ordered and what was driven");
  sub->add_option("--seed", c->seed, "seed, in place of the mission's")->check(seed_range());
  add_repeatable(sub, "--set", c->overrides, "override a setting: --set start.angle_deg=90 (may be repeated)");
}

void add_doctor(CLI::App& app, CommandLine& line) {
  CLI::App* doctor = app.add_subcommand("doctor", "Look at a robot before it is driven");
  doctor->require_subcommand(1);
  const auto [sub, c] =
      add_command(*doctor, line, doctor_live, "live", "What a mission's robot says of itself; no wheel turns");
  sub->add_option("MISSION", c->mission, "mission file whose sensor is looked at")->required();
  add_number(sub, "--for", c->for_s, "seconds to look", 0.5, 600.0);
  sub->add_flag("--wiggle", c->wiggle, "then drive 5 cm and turn 10 degrees, there and back, and see whether it stops");
  add_repeatable(sub, "--set", c->overrides, "override a setting: --set sensor.device=/dev/ttyUSB1 (may be repeated)");
}

void add_plan(CLI::App& app, CommandLine& line) {
  const auto [sub, c] = add_command(app, line, plan, "plan", "Ask a saved map for a route");
  sub->add_option("MAP", c->map, "saved map (*.cairn); with --serve also a folder of them")->required();
  sub->add_option("--from", c->question.from, "x,y | x,y,angle_deg | L12 | a name | nearest CATEGORY");
  sub->add_option("--to", c->question.to, "as --from");
  add_repeatable(sub, "--via", c->question.via, "place to pass on the way (may be repeated; in this order)");
  add_repeatable(sub, "--avoid", c->question.avoid, "landmark or cluster not to pass (may be repeated)");
  add_repeatable(sub, "--close", c->question.closed, "route not to take, as 12 or R12 (may be repeated)");
  sub->add_option("--alternatives", c->question.alternatives, "so many more routes over the landmarks")
      ->check(CLI::Range(0, 1000));
  sub->add_option("--cost", c->question.cost, "what routes over the landmarks are compared by")
      ->check(CLI::IsMember({"length", "time", "clearance"}))
      ->capture_default_str();
  sub->add_flag("--explain", c->question.explain,
                "say what the path is made of, and how the landmark graph gave the answer");
  sub->add_flag("--trajectory", c->question.trajectory, "say when the robot is where, within its speeds");
  sub->add_option("--queries", c->queries,
                  "file of queries, one {\"id\",\"from\",\"to\"} a line, or - (docs/graphs.md)");
  sub->add_option("--serve", c->serve,
                  "answer queries, a line each, at this path of a socket or HOST:PORT of this computer, until Ctrl-C "
                  "(docs/graphs.md)");
  sub->add_option("--jobs", c->jobs, "answer so many queries at once (without it, as many as there are cores)")
      ->check(CLI::Range(1, 256));
  sub->add_option("--planner", c->planner, "planner module")->capture_default_str();
  add_repeatable(
      sub, "--set", c->settings,
      "setting of the planner module (may be repeated), as in a mission's `planner`. Of hybrid: --set "
      "route.margin_m=0.05, where route is the module that plans on the grid; of ompl alone: --planner ompl --set "
      "margin_m=0.05. `cairn plugins info hybrid` and `cairn plugins info ompl` list them");
  sub->add_option("--robot", c->robot, "robot file (config/robots/*.yaml), in place of the radius saved in the map");
  add_number(sub, "--radius-m", c->radius_m, "robot radius, in place of the one saved in the map or of the robot file",
             0.0, kMaxRadius_m);
  add_number(
      sub, "--margin-m", c->margin_m,
      "room that the path keeps beside the robot. Without it 0.12, and where that leaves no path 0.06, then 0; the "
      "answer says which. With --radius-m, or a margin of the planner by --set, only what is given here",
      0.0, kMaxRadius_m);
  add_number(sub, "--budget-ms", c->budget_ms, "stop planning after this time", 0.0, 1e9);
  sub->add_option("--seed", c->seed, "seed of the planner")->check(seed_range())->capture_default_str();
  sub->add_option("--picture", c->picture, "draw the route into this PNG file");
}

void add_map(CLI::App& app, CommandLine& line) {
  CLI::App* map = app.add_subcommand("map", "Look at saved maps, import, export, name, merge, crop and compare");
  map->require_subcommand(1);
  const auto add = [&](const char* name, const char* text, auto command) {
    const auto added = add_command(*map, line, command, name, text);
    added.app->add_option("MAP", added.options->map, "saved map (*.cairn)")->required();
    return added;
  };
  add("info", "Size, landmarks and routes of a map", map_info);
  add("check", "Prove a map sound, or say exactly what is lost; exit status 2 when it is damaged", map_check);
  const auto [repair, r] = add("repair", "Save what a damaged map still holds", map_repair);
  repair->add_option("-o,--out", r->repaired, "saved map to write; never the damaged one")->required();
  const auto [render, c] = add("render", "Draw a map into a PNG file", map_render);
  render->add_option("-o,--out", c->picture, kPictureToWrite + std::string("map.png, which must not exist yet"));
}

void add_map_name(CLI::App& app, CommandLine& line) {
  const auto [name, c] =
      add_command(*app.get_subcommand("map"), line, map_name, "name", "Name a landmark or a cluster of a map");
  name->add_option("MAP", c->map, "saved map (*.cairn), changed in place")->required();
  name->add_option("WHAT", c->what, "L17, C1:L17, or the name so far")->required();
  name->add_option("NAME", c->name, "the new name; an empty one takes it away")->required();
}

void add_map_lint(CLI::App& app, CommandLine& line) {
  const auto [lint, c] =
      add_command(*app.get_subcommand("map"), line, map_lint, "lint",
                  "What is doubtful about a map's landmarks and routes; exit status 1 if anything but notes");
  lint->add_option("MAP", c->map, "saved map (*.cairn)")->required();
  add_number(lint, "--radius-m", c->radius_m, "robot radius, in place of the one saved in the map", 0.0, kMaxRadius_m);
  add_number(lint, "--near-m", c->near_m, "landmarks of one category this near to each other are taken for one", 0.0,
             1000.0);
}

void add_template(CLI::App& app, CommandLine& line) {
  CLI::App* templates = app.add_subcommand("template", "Look at landmark templates");
  templates->require_subcommand(1);
  const auto add = [&](const char* name, const char* text, auto command) {
    const auto [sub, c] = add_command(*templates, line, command, name, text);
    sub->add_option("FOLDER", c->folder, "folder of template files (config/templates)")->required();
    add_number(sub, "--cell-m", c->cell_m, "cell size of the map", 0.005, 1.0);
    add_number(sub, "--step-deg", c->step_deg, "orientation step", 1.0, 90.0);
    return std::pair(sub, c);
  };
  add("list", "Categories, sizes and orientations", template_list);
  const auto [check, checked] = add(
      "check", "Which categories the sensed templates would mistake for which; exit status 1 if any", template_check);
  check->add_option("--robot", checked->robot, "robot file whose sonars sense the templates")->required();
  const auto [preview, c] = add("preview", "Draw every template of a folder into a PNG file", template_preview);
  preview->add_option("--rendering", c->rendering, "sensed or ideal")
      ->check(CLI::IsMember({"sensed", "ideal"}))
      ->capture_default_str();
  preview->add_option("--robot", c->robot, "robot file whose sonars sense the templates");
  preview->add_option("-o,--out", c->picture, kPictureToWrite + std::string("templates.png, which must not exist yet"));
}

void add_template_capture(CLI::App& app, CommandLine& line) {
  const auto [capture, c] = add_command(*app.get_subcommand("template"), line, template_capture, "capture",
                                        "Make a template file of a thing in a saved map");
  capture->add_option("MAP", c->map, "saved map (*.cairn)")->required();
  capture->add_option("--at", c->at, "where it is: x,y or a landmark")->required();
  capture->add_option("--category", c->category, "what to call such landmarks")->required();
  add_number(capture, "--radius-m", c->radius_m, "everything that lies wholly within this of the place belongs to it",
             0.05, 20.0);
  capture->add_option("-o,--out", c->out, "template file to write")->required();
}

void add_plugins(CLI::App& app, CommandLine& line) {
  CLI::App* plugins = app.add_subcommand("plugins", "List the modules, or one module's settings");
  plugins->callback([&] {
    if (!line.action) line.action = [&] { return plugins_list(line.common); };
  });
  const auto [info, i] = add_command(*plugins, line, plugins_info, "info", "Settings of one module");
  info->add_option("NAME", i->name, "module")->required();
  info->add_option("GROUP", i->group, "a group of its settings, as driving or driving.look");
  info->add_flag("--all", i->all, "with what stands in groups");
  const auto [check, c] =
      add_command(*plugins, line, plugins_check, "check",
                  "Whether files are modules that this program can use: tries each in a process of its own");
  check->add_option("FILE", c->files, "shared libraries (*.so); without them, all that are found");
}

void add_plugins_new(CLI::App& app, CommandLine& line) {
  const auto [made, c] = add_command(*app.get_subcommand("plugins"), line, plugins_new, "new",
                                     "Write a small complete project for a module");
  made->add_option(
          "KIND", c->kind,
          "sensor, localizer, loop_closer, map, detector, marker_detector, planner, path_planner, route_planner, "
          "controller or behaviour")
      ->required();
  made->add_option("NAME", c->name, "of the module, in lower_snake_case")->required();
  made->add_option("--folder", c->folder, "of the new project; without it, NAME");
}

void add_reference(CLI::App& app, CommandLine& line) {
  const auto [sub, c] = add_command(*app.get_subcommand("plugins"), line, plugins_reference, "reference",
                                    "Every setting of every file and module");
  sub->add_option("--markdown", c->markdown, "write the configuration reference into this file");
  sub->add_option("--schema-folder", c->schema_folder, "write the JSON schemas for editors into this folder");
}

void add_chart(CLI::App& app, CommandLine& line) {
  const auto [sub, c] = add_command(app, line, chart, "chart",
                                    "Draw the tables of a Markdown file, such as an experiment's table.md, again");
  sub->add_option("FILE", c->file, "Markdown file with tables; the first column of each is the x axis")->required();
  add_repeatable(sub, "--column", c->columns, "column to draw (may be repeated); without it, all columns of numbers");
  sub->add_option("--title", c->title, "of each chart; {} stands for the heading of the table's section");
  sub->add_option("--y-label", c->y_label, "label of the y axis");
  sub->add_flag("--shares", c->of_shares, "the y axis from 0 to 1");
  sub->add_option("--out", c->out, "folder for the pictures")->capture_default_str();
  sub->add_option("--prefix", c->prefix, "of the pictures' names, before the heading");
}

// What the parser calls unexpected is most often a misspelt command.
std::optional<std::string> unknown_command(const CLI::App& app, int argc, char** argv) {
  const CLI::App* at = &app;
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    const std::vector<const CLI::App*> commands = at->get_subcommands([](const CLI::App*) { return true; });
    if (commands.empty()) return std::nullopt;
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const CLI::App* command : commands) names.push_back(command->get_name());
    const auto found = std::find(names.begin(), names.end(), argv[i]);
    if (found == names.end()) return "unknown command " + in_quotes(argv[i]) + did_you_mean(argv[i], names);
    at = commands[static_cast<std::size_t>(found - names.begin())];
  }
  return std::nullopt;
}

// The nearest of the options that the command has.
std::optional<std::string> unknown_option(const CLI::App& app) {
  std::string called = "cairn";
  std::vector<const CLI::App*> commands{&app};
  while (!commands.back()->get_subcommands().empty()) {
    commands.push_back(commands.back()->get_subcommands().front());
    called += " " + commands.back()->get_name();
  }
  const std::vector<std::string> left = app.remaining(true);
  const auto found = std::ranges::find_if(left, [](const std::string& text) { return text.starts_with("--"); });
  if (found == left.end()) return std::nullopt;
  const std::string option = found->substr(0, found->find('='));
  std::vector<std::string> names;
  for (const CLI::App* command : commands)
    for (const CLI::Option* known : command->get_options())
      for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
  return "unknown option " + in_quotes(option) + did_you_mean(option, names) + "; " + called +
         " --help lists the options";
}

int parse_error_sentence(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  std::optional<std::string> unknown = unknown_command(app, argc, argv);
  if (unknown)
    *unknown += "; cairn --help lists the commands";
  else if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
    unknown = unknown_option(app);
  if (unknown && error.get_exit_code() != 0) {
    std::cerr << "cairn: " << *unknown << "\n";
    return kExitBadInput;
  }
  return app.exit(error) == 0 ? kExitDone : kExitBadInput;
}

int status_of(int argc, char** argv) try {
  CLI::App app{"Cairn: landmark navigation for mobile robots", "cairn"};
  app.set_version_flag("--version", "cairn " CAIRN_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  CommandLine line;
  add_repeatable(&app, "--plugins", line.common.plugin_folders, "further folder of modules (may be repeated)");
  app.add_flag("--json", line.common.json, "JSON on standard output; text for people on standard error");
  for (const auto add : {add_run, add_base, add_doctor, add_mission, add_plan, add_view, add_map, add_map_files,
                         add_map_name, add_map_lint, add_template, add_template_capture, add_plugins, add_plugins_new,
                         add_reference, add_experiment, add_chart, add_slam})
    add(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return parse_error_sentence(app, error, argc, argv);
  }
  for (const std::filesystem::path& folder : line.common.plugin_folders)
    if (!std::filesystem::is_directory(folder))
      throw std::runtime_error("--plugins " + folder.string() + ": no such folder");
  const int status = line.action();
  if (!std::cout.flush()) throw std::runtime_error("standard output cannot be written");
  return status;
} catch (const std::exception& error) {
  std::cerr << "cairn: " << error.what() << "\n";
  return kExitBadInput;
}

}  // namespace
}  // namespace cairn

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is reported like a full disk
  std::signal(SIGCHLD, SIG_DFL);  // whoever started this program may have ignored how children end
  if (argc == 3 && std::string_view(argv[1]) == cairn::kModuleTrialArgument) return cairn::run_module_trial(argv[2]);
  const cairn::PrintableStream out(std::cout);
  const cairn::PrintableStream err(std::cerr);
  cairn::handle_fatal_ends();
  const int status = cairn::status_of(argc, argv);
  cairn::expect_end();
  return status;
}
