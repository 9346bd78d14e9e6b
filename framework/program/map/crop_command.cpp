#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/common/refusal.hpp"
#include "framework/program/map/number_list.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/edit/crop.hpp"

namespace cairn {

int map_crop(const CropCommand& command, const CommonOptions& common) {
  const std::vector<double> box = number_list(command.box, "x0,y0,x1,y1", "map crop: --box", kMaxCoordinate);
  const SavedMap map = load_map(command.map);
  CroppedMap cropped = refused_about("map crop: " + command.map.string(), [&] {
    return crop_map(map, {box[0], box[1]}, {box[2], box[3]});
  });
  cropped.map.properties["cropped_to"] = command.box;
  save_map(command.out, cropped.map, Links::replace);
  const std::size_t landmarks = cropped.map.graph.landmarks().size();
  const std::size_t routes = cropped.map.graph.routes().size();
  const CellBox cells = cropped.map.grid.bounds();
  std::vector<std::string> warnings;
  if (cropped.landmarks_dropped > 0)
    warnings.push_back(counted(cropped.landmarks_dropped, "landmark") + " outside: dropped");
  if (cropped.routes_dropped > 0)
    warnings.push_back(counted(cropped.routes_dropped, "route") + " to the outside or through it: dropped");
  warnings.insert(warnings.end(), cropped.warnings.begin(), cropped.warnings.end());
  print_report({{"map", command.out.string()},
                {"size_cells", {cells.width(), cells.height()}},
                {"landmarks", landmarks},
                {"routes", routes},
                {"landmarks_dropped", cropped.landmarks_dropped},
                {"routes_dropped", cropped.routes_dropped},
                {"warnings", warnings}},
               fmt::format("wrote {}: {} x {} cells, {}, {}", command.out.string(), cells.width(), cells.height(),
                           counted(landmarks, "landmark"), counted(routes, "route")),
               warnings, common);
  return kExitDone;
}

}  // namespace cairn
