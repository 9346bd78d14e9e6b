#include <nlohmann/json.hpp>

#include "framework/planning/landmark_names.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

int map_name(const NameCommand& command, const CommonOptions& common) {
  SavedMap map = load_map(command.map);
  const std::string id = give_name(map, command.what, command.name);
  save_map(command.map, map);
  print({{"map", command.map.string()}, {"id", id}, {"name", command.name}},
        id + (command.name.empty() ? " has no name any more" : " is " + command.name) + "\n", common);
  return kExitDone;
}

}  // namespace cairn
