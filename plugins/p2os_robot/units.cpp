#include "plugins/p2os_robot/units.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <numbers>

namespace cairn::p2os_robot {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

Units of_microcontroller(double position_mm, double range_mm) {
  return {position_mm / 1000.0, kTurn_rad / 4096.0, range_mm / 1000.0, true};
}

const std::map<std::string, Units, std::less<>>& all() {
  static const Units kPioneer1{0.05066 / 1000.0, kTurn_rad / 1024.0, 0.1734 / 1000.0, false};
  static const std::map<std::string, Units, std::less<>> kUnits{
      {"amigo", of_microcontroller(0.5083, 1.0)},
      {"amigo-sh", of_microcontroller(1.0, 1.0)},
      {"p2at", of_microcontroller(1.32, 0.268)},
      {"p2at8", of_microcontroller(1.32, 1.0)},
      {"p2ce", of_microcontroller(0.826, 0.268)},
      {"p2d8", of_microcontroller(0.485, 1.0)},
      {"p2de", of_microcontroller(0.969, 0.268)},
      {"p2df", of_microcontroller(0.485, 0.268)},
      {"p2dx", of_microcontroller(0.84, 0.268)},
      {"p2it", of_microcontroller(1.136, 0.268)},
      {"p3at", of_microcontroller(0.465, 1.0)},
      {"p3at-sh", of_microcontroller(1.0, 1.0)},
      {"p3dx", of_microcontroller(0.485, 1.0)},
      {"p3dx-sh", of_microcontroller(1.0, 1.0)},
      {"p3dx-sh-lms1xx", of_microcontroller(1.0, 1.0)},
      {"pion1m", kPioneer1},
      {"psos1m", kPioneer1},
  };
  return kUnits;
}

}  // namespace

std::optional<Units> units_of(std::string_view subclass) {
  std::string name(subclass);
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = all().find(name);
  return found == all().end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> known_subclasses() {
  std::vector<std::string> names;
  for (const auto& [name, units] : all()) names.push_back(name);
  return names;
}

}  // namespace cairn::p2os_robot
