// The saved maps that `cairn plan --serve` answers questions about: one file, or all of a folder. Read only.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/modules/module_library.hpp"
#include "framework/planning/saved_map/map_planner.hpp"

namespace cairn {

// A sentence for who has asked.
class NoSuchMap : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ServedMaps {
 public:
  // options.map: a map, or a folder. The library must outlive it. Throws ConfigError when there is neither.
  ServedMaps(MapPlannerOptions options, const ModuleLibrary& library);

  // Without ".cairn", by their names, as they are there now.
  [[nodiscard]] std::vector<std::string> names() const;
  // From any thread. Read when it is first asked for, and again once its file is another; those that are answering keep
  // what they have. An empty name: the only one. Throws NoSuchMap, and what reading it throws.
  [[nodiscard]] std::shared_ptr<const MapPlanner> planner(const std::string& name);

 private:
  struct FileState {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    bool operator==(const FileState&) const = default;
  };
  struct Entry {
    std::mutex reading;
    FileState state;
    std::shared_ptr<const MapPlanner> planner;
  };
  [[nodiscard]] std::filesystem::path file_of(const std::string& name) const;

  MapPlannerOptions options_;
  const ModuleLibrary& library_;
  bool is_folder_ = false;
  std::mutex entries_lock_;
  std::map<std::string, std::shared_ptr<Entry>> entries_;
};

}  // namespace cairn
