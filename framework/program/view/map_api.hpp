// What the page asks of a saved map.
#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "framework/modules/module_library.hpp"
#include "framework/planning/saved_map/map_planner.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/view/view_request.hpp"

namespace cairn {

class MapApi {
 public:
  // Loads the map. Throws what MapPlanner throws.
  MapApi(const MapPlannerOptions& plan, const CommonOptions& common);

  // None: it has no such thing. From any thread, one after the other: a plan makes others wait.
  [[nodiscard]] std::optional<ViewResponse> answer(const ViewRequest& request);

 private:
  [[nodiscard]] ViewResponse plan(const std::string& body) const;

  std::mutex mutex_;
  ModuleLibrary library_;
  MapPlanner planner_;
  std::string name_;
  std::string options_;  // of the command line that gives the same plan
};

}  // namespace cairn
