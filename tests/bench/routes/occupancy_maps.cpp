#include "tests/bench/routes/occupancy_maps.hpp"

#include <algorithm>

#include "framework/files/map_server_file.hpp"
#include "tests/bench/graph/unpacked.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;

OccupancyGrid grid_of_picture(const fs::path& picture, const MapServerSettings& settings) {
  const fs::path file = fs::exists(picture) ? picture : fs::path(picture.string() + ".gz");
  return grid_of(parse_grey_picture(unpacked(file), file.string()), settings, file.string()).grid;
}

bool names_a_picture(const std::string& yaml) {
  return yaml.starts_with("image:") || yaml.find("\nimage:") != std::string::npos;
}

}  // namespace

std::vector<OccupancyMap> occupancy_maps() {
  std::vector<OccupancyMap> maps;
  const fs::path folder = data_folder() / "occ_maps";
  if (!fs::is_directory(folder)) return maps;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const std::string text = unpacked(file);
    if (!names_a_picture(text)) continue;
    const MapServerFile map = parse_map_server_yaml(text, file.string());
    maps.push_back({file.stem().string(), grid_of_picture(map.picture, map.settings)});
  }
  for (const std::string name : {"Freiburg79_scan", "lab_ipa", "office_a", "office_h"})
    if (const fs::path file = folder / "ipa_rooms" / (name + ".png"); fs::exists(file))
      maps.push_back({name, grid_of_picture(file, {})});
  return maps;
}

}  // namespace cairn
