#include "maps/exchange/graphs/crs.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace cairn::exchange {
namespace {

// "urn:ogc:def:crs:EPSG::3857" and "EPSG:3857" as "3857".
std::string_view epsg_code(std::string_view name) {
  if (name.find("EPSG") == std::string_view::npos && name.find("epsg") == std::string_view::npos) return {};
  return name.substr(std::min(name.size(), name.find_last_of(":/") + 1));
}

}  // namespace

bool is_nav2_crs(std::string_view name) {
  return epsg_code(name) == "3857";
}

bool is_geographic_crs(std::string_view name) {
  static constexpr std::array<std::string_view, 6> kCodes{"4326", "4979", "4258", "4269", "4267", "4283"};
  static constexpr std::array<std::string_view, 4> kNames{"CRS84", "CRS83", "CRS27", "WGS84"};
  std::string upper(name);
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return std::ranges::find(kCodes, epsg_code(name)) != kCodes.end() ||
         std::ranges::any_of(kNames, [&](std::string_view known) { return upper.ends_with(known); });
}

}  // namespace cairn::exchange
