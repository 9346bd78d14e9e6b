// What the tests of the exchange formats share: refusals as text, and random graphs.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "maps/base/source_text.hpp"
#include "maps/exchange/graphs/exchanged_graph.hpp"

namespace cairn {

// What the reader says against the text, "line:column: sentence".
template <class Parse>
std::string refusal_of(Parse parse, const std::string& text) {
  try {
    static_cast<void>(parse(text, "map.in"));
  } catch (const ExchangeError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("map.in:"));
    return std::string(error.what()).substr(7);
  }
  return "accepted";
}

inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Of one bit pattern in many: tiny, huge, negative, whole.
inline double random_number(std::mt19937_64& random) {
  const double fraction = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
  switch (random() % 4) {
    case 0:
      return std::round(fraction * 1000.0);
    case 1:
      return std::ldexp(fraction, static_cast<int>(random() % 200) - 100);
    default:
      return fraction * 100.0;
  }
}

inline double random_coordinate(std::mt19937_64& random) {
  return std::remainder(random_number(random), 2.0 * exchange::kMaxCoordinate_m);
}

inline std::string random_name(std::mt19937_64& random) {
  static const std::vector<std::string> kParts{"dock", "<&>", "\"q\"", "\xC3\xA4", " ", "#", "'", "]]>", "L7", "a\\b"};
  std::string name = "n";  // begins with a letter, so that a line of the plain list holds it
  for (std::uint64_t i = random() % 4; i > 0; --i) name += kParts[random() % kParts.size()];
  return name + "e";
}

// What every format holds; ids have gaps, routes are parallel, loops, cost nothing.
inline LandmarkGraph random_graph(std::mt19937_64& random) {
  LandmarkGraph graph;
  std::vector<LandmarkId> ids;
  const std::uint64_t count = 1 + random() % 12;
  for (LandmarkId id = 1 + static_cast<LandmarkId>(random() % 3); ids.size() < count;
       id += 1 + static_cast<LandmarkId>(random() % 5)) {
    Landmark landmark;
    landmark.id = id;
    if (random() % 2 == 0) landmark.name = random_name(random);
    const double x_m = random_coordinate(random);
    landmark.T_map_landmark = {x_m, random_coordinate(random), 0.0};
    ids.push_back(graph.add(landmark));
  }
  for (std::uint64_t i = random() % 20; i > 0; --i) {
    Route route;
    route.from = ids[random() % ids.size()];
    route.to = ids[random() % ids.size()];
    route.cost_m = random() % 5 == 0 ? 0.0 : std::abs(random_number(random));
    graph.add_route(route);
  }
  return graph;
}

// The graph as an empty map would load it: ids to come follow the largest ones.
inline void expect_same_content(const LandmarkGraph& a, const LandmarkGraph& b) {
  EXPECT_EQ(a.landmarks(), b.landmarks());
  EXPECT_EQ(a.routes(), b.routes());
}

inline std::filesystem::path nav2_folder() {
  const char* data = std::getenv("CAIRN_DATA");
  const std::filesystem::path root =
      data != nullptr ? std::filesystem::path(data) : std::filesystem::path(CAIRN_SOURCE_DIR) / "../shared/data";
  return root / "graphs/nav2_route";
}

}  // namespace cairn
