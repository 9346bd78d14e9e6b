#include "tests/bench/routes/moving_ai_set.hpp"

#include <algorithm>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>

#include "tests/bench/graph/unpacked.hpp"

namespace cairn {
namespace {

// Of a line of a scenario file; y down.
std::optional<MovingAiInstance> instance_of(const std::string& line) {
  std::istringstream words(line);
  std::string map;
  int bucket = 0;
  int width = 0;
  int height = 0;
  MovingAiInstance instance;
  words >> bucket >> map >> width >> height >> instance.from.x >> instance.from.y >> instance.to.x >> instance.to.y >>
      instance.optimum;
  return words ? std::optional(instance) : std::nullopt;
}

}  // namespace

PlainCells moving_ai_cells(const std::filesystem::path& map_file) {
  std::istringstream in(unpacked(map_file));
  PlainCells cells;
  std::string word;
  std::string octile;
  in >> word >> octile;
  for (int i = 0; i < 2; ++i) {
    in >> word;
    in >> (word == "height" ? cells.height : cells.width);
  }
  in >> word;
  if (word != "map" || cells.width <= 0 || cells.height <= 0) throw std::runtime_error(map_file.string() + ": no map");
  cells.open.assign(static_cast<std::size_t>(cells.width) * static_cast<std::size_t>(cells.height), 0);
  for (int y = cells.height - 1; y >= 0; --y) {
    in >> word;
    if (!in || word.size() != static_cast<std::size_t>(cells.width))
      throw std::runtime_error(map_file.string() + ": a row is broken");
    for (int x = 0; x < cells.width; ++x) {
      const char c = word[static_cast<std::size_t>(x)];
      cells.open[cells.index(x, y)] = c == '.' || c == 'G' || c == 'S' ? 1 : 0;
    }
  }
  return cells;
}

std::vector<MovingAiInstance> moving_ai_instances(const std::filesystem::path& scenario_file, int height,
                                                  std::size_t count, std::uint64_t seed) {
  std::istringstream in(unpacked(scenario_file));
  std::vector<MovingAiInstance> all;
  std::string line;
  std::getline(in, line);  // version
  while (std::getline(in, line)) {
    std::optional<MovingAiInstance> instance = instance_of(line);
    if (!instance) continue;
    for (Cell* const cell : {&instance->from, &instance->to}) {
      if (cell->x < 0 || cell->y < 0 || cell->y >= height)
        throw std::runtime_error(scenario_file.string() + ": an instance is not on the map: " + line);
      cell->y = height - 1 - cell->y;
    }
    all.push_back(*instance);
  }
  if (all.size() <= count) return all;
  std::mt19937_64 random(seed);
  std::vector<MovingAiInstance> some;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * all.size() / count;
    const std::size_t end = (i + 1) * all.size() / count;
    some.push_back(all[begin + random() % (end - begin)]);
  }
  return some;
}

std::vector<std::filesystem::path> moving_ai_maps(const std::string& set) {
  std::vector<std::filesystem::path> maps;
  const auto folder = data_folder() / "movingai" / set;
  if (!std::filesystem::is_directory(folder)) return maps;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().string().ends_with(".map.gz")) maps.push_back(entry.path());
  std::sort(maps.begin(), maps.end());
  return maps;
}

std::filesystem::path scenario_of(const std::filesystem::path& map_file) {
  std::filesystem::path file = map_file;
  return file.replace_extension(".scen.gz");  // NAME.map.gz to NAME.map.scen.gz
}

}  // namespace cairn
