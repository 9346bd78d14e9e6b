#include <nlohmann/json.hpp>

#include "framework/program/common/print.hpp"
#include "framework/program/map/map_edits.hpp"

namespace cairn {

int map_name(const NameCommand& command, const CommonOptions& common) {
  const std::string id = name_in_map(command.map, command.what, command.name);
  print({{"map", command.map.string()}, {"id", id}, {"name", command.name}},
        id + (command.name.empty() ? " has no name any more" : " is " + command.name) + "\n", common);
  return kExitDone;
}

}  // namespace cairn
