// What importing and exporting a landmark graph gives.
#pragma once

#include <string>
#include <vector>

#include "maps/landmark_graph.hpp"

namespace cairn {

struct ImportedGraph {
  LandmarkGraph graph;
  std::vector<std::string> warnings;  // sentences: by which rule something doubtful was accepted
};

struct ExportedGraph {
  std::string text;                   // of the file, UTF-8
  std::vector<std::string> warnings;  // sentences: what the format cannot hold
};

}  // namespace cairn
