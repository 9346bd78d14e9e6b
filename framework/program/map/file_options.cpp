#include "framework/program/map/file_options.hpp"

namespace cairn {
namespace {

void add_exchange(CLI::App& map, CommandLine& line) {
  const auto [in, c] =
      add_command(map, line, map_import, "import", "Make a map of another tool's landmark graph or occupancy grid");
  in->add_option("FILE", c->from,
                 "*.graph, nav2 routes (*.geojson, *.json), *.graphml, road network (*_net.tntp), Open-RMF building or "
                 "navigation graph (*.yaml), Moving AI grid (*.map), map_server (*.yaml) or a picture (*.png, *.pgm, "
                 "*.bmp); each also as *.gz")
      ->required();
  in->add_option("-o,--out", c->to, "saved map to write (*.cairn)")->required();
  add_number(in, "--cell-m", c->cell_m, "cell size of a picture, or of a Moving AI grid (without it 1)", 0.001, 1000.0);
  in->add_option(
      "--clusters", c->clusters,
      "key=value: how a graph is clustered, as under `clusters` of a mission: max_landmarks=16; kept in the map");
  in->add_flag("--allow-outside", c->allow_outside, "read a picture that is outside the folder of the file");
  const auto [out, e] = add_command(map, line, map_export, "export",
                                    "Write a map's landmark graph or grid for other tools, or its picture");
  out->add_option("MAP", e->from, "saved map (*.cairn)")->required();
  out->add_option(
         "-o,--out", e->to,
         "file to write: *.graph, *.geojson, *.json, *.graphml, Open-RMF (*.nav.yaml), map_server (*.yaml and its "
         "picture) or *.png")
      ->required();
  out->add_option("--mode", e->mode, "how map_server is to read the picture: trinary (without it), scale or raw")
      ->check(CLI::IsMember({"trinary", "scale", "raw"}));
  out->add_option("--picture", e->picture, "map_server's picture: pgm, png or bmp (without it pgm, in mode scale png)")
      ->check(CLI::IsMember({"pgm", "png", "bmp"}));
  add_number(out, "--scale", e->px_per_cell, "a *.png of the bare grid with so many pixels a cell, 0.25 or 3", 1e-6,
             65536.0);
}

void add_merge(CLI::App& map, CommandLine& line) {
  const auto [merge, c] =
      add_command(map, line, map_merge, "merge",
                  "Lay a second map into the frame of a first; exit status 1: they do not show where");
  merge->add_option("A", c->a, "saved map (*.cairn), whose frame counts")->required();
  merge->add_option("B", c->b, "saved map to lay into it")->required();
  merge->add_option("--transform", c->transform,
                    "x,y,deg: where B's frame lies in A's. Without it, it is found out by what both show");
  add_number(merge, "--near-m", c->near_m, "landmarks of one category this near to each other are one", 0.0, 1000.0);
  merge->add_option("-o,--out", c->out, "saved map to write")->required();
}

void add_crop(CLI::App& map, CommandLine& line) {
  const auto [crop, c] = add_command(map, line, map_crop, "crop", "Cut a part out of a map");
  crop->add_option("MAP", c->map, "saved map (*.cairn)")->required();
  crop->add_option("--box", c->box, "x0,y0,x1,y1: two opposite corners, in metres")->required();
  crop->add_option("-o,--out", c->out, "saved map to write")->required();
}

void add_diff(CLI::App& map, CommandLine& line) {
  const auto [diff, c] = add_command(map, line, map_diff, "diff",
                                     "What differs between two maps of one frame; exit status 0 the same, 1 different");
  diff->add_option("A", c->a, "saved map (*.cairn)")->required();
  diff->add_option("B", c->b, "saved map to compare with it")->required();
  add_number(diff, "--near-m", c->near_m, "landmarks of one category this near to each other are taken for one", 0.0,
             1000.0);
  diff->add_option("--picture", c->picture, "draw what is new, gone and the same into this PNG file");
}

void add_close(CLI::App& map, CommandLine& line) {
  const auto add = [&](const char* name, const char* text, auto command) {
    const auto [sub, c] = add_command(map, line, command, name, text);
    sub->add_option("MAP", c->map, "saved map (*.cairn), changed in place")->required();
    sub->add_option("ROUTE", c->routes, "numbers of routes, 12 or R12")->required();
    sub->add_flag("--both-ways", c->both_ways, "the routes that lead back, too");
  };
  add("close", "Close routes of a map: no plan takes them", map_close);
  add("open", "Open closed routes of a map again", map_open);
}

}  // namespace

void add_map_files(CLI::App& app, CommandLine& line) {
  CLI::App& map = *app.get_subcommand("map");
  for (const auto add : {add_exchange, add_merge, add_crop, add_diff, add_close}) add(map, line);
}

}  // namespace cairn
