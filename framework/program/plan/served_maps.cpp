#include "framework/program/plan/served_maps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "framework/config/config_value.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/spelling.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".cairn";
constexpr std::size_t kMaxListed = 20;

}  // namespace

ServedMaps::ServedMaps(MapPlannerOptions options, const ModuleLibrary& library)
    : options_(std::move(options)), library_(library) {
  std::error_code error;
  is_folder_ = fs::is_directory(options_.map, error);
  if (!is_folder_ && !fs::exists(options_.map, error)) throw ConfigError({options_.map.string(), 0, 0}, "no such file");
  if (names().empty()) throw ConfigError({options_.map.string(), 0, 0}, "holds no saved map (*.cairn)");
}

std::vector<std::string> ServedMaps::names() const {
  if (!is_folder_) return {options_.map.stem().string()};
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(options_.map, error))
    if (entry.path().extension() == kEnding && !entry.path().filename().string().starts_with('.') &&
        entry.is_regular_file(error))
      names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

// Only names of the list are looked up: no path leads out of the folder.
fs::path ServedMaps::file_of(const std::string& name) const {
  const std::vector<std::string> all = names();
  if (name.empty() && all.size() == 1)
    return is_folder_ ? options_.map / (all[0] + std::string(kEnding)) : options_.map;
  const std::vector<std::string> some(all.begin(), all.begin() + std::min<std::ptrdiff_t>(std::ssize(all), kMaxListed));
  const std::string list = fmt::format("{}{}", fmt::join(some, ", "), all.size() > some.size() ? ", ..." : "");
  if (name.empty()) throw NoSuchMap("which \"map\"? There are " + list);
  if (std::ranges::find(all, name) == all.end())
    throw NoSuchMap(fmt::format("no map {}{}; there are {}", in_quotes(name), did_you_mean(name, all), list));
  return is_folder_ ? options_.map / (name + std::string(kEnding)) : options_.map;
}

std::shared_ptr<const MapPlanner> ServedMaps::planner(const std::string& name) {
  MapPlannerOptions options = options_;
  options.map = file_of(name);
  std::shared_ptr<Entry> entry;
  {
    const std::scoped_lock lock(entries_lock_);
    std::shared_ptr<Entry>& known = entries_[options.map.string()];
    if (!known) known = std::make_shared<Entry>();
    entry = known;
  }
  // Who asks for another map does not wait for this one.
  const std::scoped_lock lock(entry->reading);
  const FileState now{fs::last_write_time(options.map), fs::file_size(options.map)};
  if (!entry->planner || !(entry->state == now)) {
    entry->planner = std::make_shared<MapPlanner>(options, PlannerUse::many_at_once, library_);
    entry->state = now;
  }
  return entry->planner;
}

}  // namespace cairn
