// Sensed templates kept between runs: rendering a folder of them takes seconds, reading them milliseconds.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/module.hpp"
#include "framework/contracts/robot_model.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn {

class ModuleLibrary;
struct SensedOptions;

// One file a key, named after the key's hash, and holding the whole key: two keys are never mixed up. A
// file that is broken, or cannot be read or written, counts as not there. Writes in one step, so that
// processes can share a folder.
class TemplateCache {
 public:
  // An empty folder: keeps nothing.
  explicit TemplateCache(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

  [[nodiscard]] std::optional<std::vector<LandmarkTemplate>> find(const std::string& key) const;
  void keep(const std::string& key, const std::vector<LandmarkTemplate>& templates) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const std::string& key) const;

  std::filesystem::path folder_;
};

// CAIRN_TEMPLATE_CACHE, a folder, or `off`; without it $XDG_CACHE_HOME/cairn/templates or
// ~/.cache/cairn/templates. Empty: none.
[[nodiscard]] std::filesystem::path template_cache_folder();

// All that the templates of any shape depend on beside the shape: robot, modules with their settings and
// their very code, and how they are rendered.
[[nodiscard]] std::string rendering_key(double step_rad, double cell_m, const SensedOptions& options,
                                        const RobotModel& robot, const PluginChoice& sensor, const PluginChoice& map,
                                        const ModuleLibrary& library);
// Such a key with the shape.
[[nodiscard]] std::string shape_key(const std::string& rendering_key, const LandmarkShape& shape);

}  // namespace cairn
