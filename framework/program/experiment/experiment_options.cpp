#include "framework/program/experiment/experiment_options.hpp"

namespace cairn {

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

}  // namespace cairn
