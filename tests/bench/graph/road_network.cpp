#include "tests/bench/graph/road_network.hpp"

#include <array>
#include <sstream>
#include <stdexcept>

#include "tests/bench/graph/unpacked.hpp"

namespace cairn {
namespace {

// Whether the line begins with that many numbers; headings and notes do not.
template <std::size_t count>
bool read_numbers(const std::string& line, std::array<double, count>& numbers) {
  std::istringstream words(line);
  for (double& number : numbers)
    if (!(words >> number)) return false;
  return true;
}

}  // namespace

LandmarkGraph road_network(const std::filesystem::path& folder, const std::string& name) {
  LandmarkGraph graph;
  std::istringstream nodes(unpacked(folder / (name + "_node.tntp.gz")));
  std::array<double, 3> node{};  // id, x, y
  for (std::string line; std::getline(nodes, line);) {
    if (!read_numbers(line, node)) continue;
    Landmark landmark;
    landmark.id = static_cast<LandmarkId>(node[0]);
    landmark.T_map_landmark = {node[1], node[2], 0.0};
    graph.add(std::move(landmark));
  }
  std::istringstream links(unpacked(folder / (name + "_net.tntp.gz")));
  std::array<double, 4> link{};  // from, to, capacity, length
  for (std::string line; std::getline(links, line);) {
    if (!read_numbers(line, link)) continue;
    Route route;
    route.from = static_cast<LandmarkId>(link[0]);
    route.to = static_cast<LandmarkId>(link[1]);
    route.cost_m = link[3];
    graph.add_route(std::move(route));
  }
  if (graph.routes().empty()) throw std::runtime_error(name + ": has no links");
  return graph;
}

}  // namespace cairn
