// What importing and exporting a landmark graph gives.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

struct ImportedGraph {
  LandmarkGraph graph;
  std::vector<std::string> warnings;  // sentences: by which rule something doubtful was accepted
  // What other tools keep with the whole graph, by format: the text of a JSON object.
  std::map<std::string, std::string> properties = {};
};

struct ExportedGraph {
  std::string text;                   // of the file, UTF-8
  std::vector<std::string> warnings;  // sentences: what the format cannot hold
};

}  // namespace cairn
