#include <nlohmann/json.hpp>

#include "framework/program/common/print.hpp"
#include "framework/program/map/map_edits.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

int set_closed(const CloseCommand& command, bool closed, const CommonOptions& common) {
  const std::vector<RouteId> changed = set_closed_in_map(command, closed);
  std::string text;
  for (const RouteId id : changed) text += (text.empty() ? "R" : ", R") + std::to_string(id);
  const char* now = closed ? "closed" : "open";
  print_report({{"map", command.map.string()}, {"changed", changed}, {"closed", closed}},
               changed.empty() ? std::string("nothing to do: already ") + now
                               : counted(changed.size(), "route") + " " + now + ": " + text,
               {}, common);
  return kExitDone;
}

}  // namespace

int map_close(const CloseCommand& command, const CommonOptions& common) {
  return set_closed(command, true, common);
}

int map_open(const CloseCommand& command, const CommonOptions& common) {
  return set_closed(command, false, common);
}

}  // namespace cairn
