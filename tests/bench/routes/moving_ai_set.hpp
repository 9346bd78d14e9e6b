// Maps and instances of the Moving AI benchmarks (N. Sturtevant, Benchmarks for Grid-Based Pathfinding, 2012), read
// anew and not by the project's own reader.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/bench/routes/plain_cells.hpp"

namespace cairn {

// y up, as everywhere: the origin is the lower left of the picture, a cell 1 m wide.
[[nodiscard]] PlainCells moving_ai_cells(const std::filesystem::path& map_file);

struct MovingAiInstance {
  Cell from;
  Cell to;
  double optimum = 0.0;  // over eight neighbours, in cells, as the file says (six digits)
};

// So many, each drawn from another equal part of the file, which is in order of length; all when there are fewer.
// Throws std::runtime_error when one is not on a map of that height.
[[nodiscard]] std::vector<MovingAiInstance> moving_ai_instances(const std::filesystem::path& scenario_file, int height,
                                                                std::size_t count, std::uint64_t seed);

// NAME.map.gz of a set below the data folder, in order; none when the set is not there.
[[nodiscard]] std::vector<std::filesystem::path> moving_ai_maps(const std::string& set);
[[nodiscard]] std::filesystem::path scenario_of(const std::filesystem::path& map_file);

}  // namespace cairn
