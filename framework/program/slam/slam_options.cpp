#include "framework/program/slam/slam_options.hpp"

namespace cairn {

void add_slam(CLI::App& app, CommandLine& line) {
  const auto [eval, e] = add_command(app, line, slam_eval, "slam-eval",
                                     "Compare estimated poses with relations that a SLAM benchmark states");
  eval->add_option("RELATIONS", e->relations, "one a line: T1 T2 DX DY DZ ROLL PITCH YAW")->required();
  eval->add_option("POSES", e->poses, "one a line: T X Y THETA, or T X Y Z QX QY QZ QW")->required();
  add_number(eval, "--tolerance-s", e->tolerance_s, "stamps this near to each other are the same", 0.0, 3600.0);
  const auto [solve, s] =
      add_command(app, line, slam_solve, "slam-solve", "Find the poses that fit the edges of a planar pose graph best");
  solve->add_option("GRAPH", s->graph, "pose graph of g2o: VERTEX_SE2 and EDGE_SE2")->required();
  solve->add_option("-o,--out", s->out, "file for the graph with the poses found");
  solve->add_flag("--robust", s->robust,
                  "trust the first edge from each vertex to the next one in the file only, and leave out those others "
                  "that do not agree");
}

}  // namespace cairn
