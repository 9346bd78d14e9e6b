#include "framework/planning/saved_map/saved_radius.hpp"

#include "framework/contracts/robot_model.hpp"
#include "framework/planning/saved_map/map_planner_options.hpp"
#include "maps/base/text.hpp"

namespace cairn {

double saved_radius_m(const SavedMap& map, const std::filesystem::path& file) {
  const auto found = map.properties.find(kRobotRadiusProperty);
  if (found == map.properties.end()) return RobotModel{}.radius_m;
  const std::string& text = found->second;
  const auto radius_m = number_from<double>(text);
  if (!radius_m || !(*radius_m >= 0.0 && *radius_m <= kMaxRadius_m))
    throw StoreError(file.string() + ": robot_radius_m must be a number of 0 to 10 m, is \"" + text + "\"");
  return *radius_m;
}

}  // namespace cairn
