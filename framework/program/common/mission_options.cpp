#include "framework/program/common/mission_options.hpp"

#include <CLI/CLI.hpp>
#include <utility>

namespace cairn {
namespace {

void add_control(CLI::App& mission, CommandLine& line) {
  const auto add = [&](const char* name, const char* about, auto command) {
    const auto [sub, c] = add_command(mission, line, command, name, about);
    sub->add_option("OUT", c->out, "output folder of the run")->required();
    c->command = name;
  };
  add("pause", "Stop the robot of a running mission; readings still come, the mission's clock stands", mission_control);
  add("resume", "Let a paused mission go on", mission_control);
  add("cancel", "End a running mission: the robot stops, the map is saved", mission_control);
  const auto [order, o] = add_command(mission, line, mission_control, "order",
                                      "Give a running mission an order, which its step await_orders carries out");
  order->add_option("OUT", o->out, "output folder of the run")->required();
  order
      ->add_option("ORDER", o->order, R"(as JSON: '{"goto": "pillar"}'; also explore, return_home, name, stop, finish)")
      ->required();
  o->command = "order";
  add("status", "How a mission stands, or what has come of it", mission_status);
}

}  // namespace

void add_pace(CLI::App* run, double& pace) {
  const auto to_number = [](std::string& text) {
    if (text == "max")
      text = "0";
    else if (const std::string refusal = number_within(0.01, 1000.0)(text); !refusal.empty())
      return refusal + ", or max";
    return std::string();
  };
  CLI::Option* option = run->add_option("--pace", pace,
                                        "seconds of the mission in one of the clock, or max: as fast as "
                                        "the machine (as without it); changes no result");
  option->transform(CLI::Validator(to_number, "FLOAT or max", "pace"));
  run->add_flag_callback(
         "--realtime", [&pace] { pace = 1.0; }, "the same as --pace 1")
      ->excludes(option);
}

void add_mission(CLI::App& app, CommandLine& line) {
  CLI::App* mission = app.add_subcommand("mission", "Check and show missions; pause, resume, cancel running ones");
  mission->require_subcommand(1);
  const auto [check, c] = add_command(*mission, line, mission_check, "check",
                                      "All that is wrong with mission files; exit status 2 if anything");
  check->add_option("FILE", c->files, "mission file (may be repeated)")->required();
  const auto [show, s] =
      add_command(*mission, line, mission_show, "show", "The steps as a tree, with all sub-missions");
  show->add_option("FILE", s->file, "mission file")->required();
  show->add_option("--picture", s->picture, "draw the tree into this PNG file");
  for (const auto& [sub, overrides] : {std::pair(check, &c->overrides), std::pair(show, &s->overrides)})
    add_repeatable(sub, "--set", *overrides, "override a setting, as for `cairn run` (may be repeated)");
  add_control(*mission, line);
}

void add_experiment(CLI::App& app, CommandLine& line) {
  const auto [sub, c] =
      add_command(app, line, experiment, "experiment", "Run an experiment over many seeds and write its table");
  sub->add_option("FILE", c->file, "experiment file (config/experiments/*.yaml)")->required();
  sub->add_option("--out", c->out, "folder for the table and reports")->capture_default_str();
  add_repeatable(sub, "--set", c->overrides, "override a setting of the file, as seeds.count=20 (may be repeated)");
  CLI::Option* const shard =
      sub->add_option("--shard", c->shard, "run a part of it, as 3/16: the third of sixteen, all with the same --out");
  sub->add_flag("--merge", c->merge, "run nothing: write the table of what the shards have run")->excludes(shard);
}

}  // namespace cairn
