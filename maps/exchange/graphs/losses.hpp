// What a file format cannot hold of a landmark graph, reported to whoever exports.
#pragma once

#include <string>
#include <vector>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn::exchange {

// What a format holds beside ids, positions, names, route ends and costs.
struct Holds {
  bool category = false;
  bool heading = false;
  bool level = false;
  bool access = false;
  bool annotations = false;
  bool marker = false;
  bool speed_limit = false;
  bool trajectory = false;
  bool driven = false;
  bool closed = false;
  bool route_ids = false;
};

// One sentence for each thing that is in the graph and that the format does not hold, with how often it is there.
[[nodiscard]] std::vector<std::string> warnings_of_loss(const LandmarkGraph& graph, const Holds& format);

}  // namespace cairn::exchange
