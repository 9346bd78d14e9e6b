#include "framework/program/common/mission_options.hpp"

#include <CLI/CLI.hpp>
#include <utility>

namespace cairn {
namespace {

void add_control(CLI::App& mission, MissionControlCommand& c, const CommonOptions& common, Action& action) {
  const std::pair<const char*, const char*> commands[] = {
      {"pause", "Stop the robot of a running mission; readings still come, the mission's clock stands"},
      {"resume", "Let a paused mission go on"},
      {"cancel", "End a running mission: the robot stops, the map is saved"}};
  for (const auto& [name, about] : commands) {
    CLI::App* sub = mission.add_subcommand(name, about);
    sub->add_option("OUT", c.out, "output folder of the run")->required();
    sub->callback([&, name = name] {
      c.command = name;
      action = [&] { return mission_control(c, common); };
    });
  }
  CLI::App* status = mission.add_subcommand("status", "How a mission stands, or what has come of it");
  status->add_option("OUT", c.out, "output folder of the run")->required();
  status->callback([&] { action = [&] { return mission_status(c, common); }; });
}

}  // namespace

void add_mission(CLI::App& app, MissionOptions& c, const CommonOptions& common, Action& action) {
  CLI::App* mission = app.add_subcommand("mission", "Check and show missions; pause, resume, cancel running ones");
  mission->require_subcommand(1);
  CLI::App* check = mission->add_subcommand("check", "All that is wrong with mission files; exit status 2 if anything");
  check->add_option("FILE", c.check.files, "mission file (may be repeated)")->required();
  CLI::App* show = mission->add_subcommand("show", "The steps as a tree, with all sub-missions");
  show->add_option("FILE", c.show.file, "mission file")->required();
  show->add_option("--picture", c.show.picture, "draw the tree into this PNG file");
  for (const auto& [sub, overrides] : {std::pair(check, &c.check.overrides), std::pair(show, &c.show.overrides)})
    sub->add_option("--set", *overrides, "override a setting, as for `cairn run` (may be repeated)")
        ->allow_extra_args(false);
  check->callback([&] { action = [&] { return mission_check(c.check, common); }; });
  show->callback([&] { action = [&] { return mission_show(c.show, common); }; });
  add_control(*mission, c.control, common, action);
}

}  // namespace cairn
