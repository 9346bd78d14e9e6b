#include "framework/program/view/folder_map.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace cairn {

namespace fs = std::filesystem;

fs::path map_in(const fs::path& folder) {
  std::ifstream in(folder / "report.json", std::ios::binary);
  const nlohmann::json report = nlohmann::json::parse(in, nullptr, false);
  if (report.is_object() && report.contains("map") && report["map"].is_string()) {
    fs::path named = folder / fs::path(report["map"].get<std::string>()).filename();
    if (fs::is_regular_file(named)) return named;
  }
  std::vector<fs::path> maps;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".cairn") maps.push_back(entry.path());
  if (maps.size() == 1) return maps.front();
  throw std::runtime_error(fmt::format("view: {} holds {} saved maps (*.cairn); name one", folder.string(),
                                       maps.empty() ? "no" : "several"));
}

}  // namespace cairn
