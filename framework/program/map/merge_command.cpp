#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/common/refusal.hpp"
#include "framework/program/map/number_list.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/edit/merge.hpp"

namespace cairn {

int map_merge(const MergeCommand& command, const CommonOptions& common) {
  const std::vector<double> transform =
      number_list(command.transform, "x,y,deg", "map merge: --transform", kMaxCoordinate);
  const std::string both = "map merge: " + command.a.string() + " and " + command.b.string();
  std::error_code error;
  if (std::filesystem::equivalent(command.a, command.b, error))
    throw std::runtime_error(both + " are the same file, whose evidence would count twice");
  const SavedMap a = load_map(command.a);
  const SavedMap b = load_map(command.b);
  // Cells of different size, or far too many.
  MergedMap merged = refused_about<std::logic_error>(both, [&] {
    return merge_maps(a, b, {{transform[0], transform[1], wrap_angle(radians(transform[2]))}, command.near_m});
  });
  std::string& history = merged.map.properties["merged_from"];
  history += (history.empty() ? "" : "; ") + command.b.filename().string() + " at " + command.transform;
  save_map(command.out, merged.map, Links::replace);
  const std::size_t landmarks = merged.map.graph.landmarks().size();
  const std::size_t routes = merged.map.graph.routes().size();
  const CellBox box = merged.map.grid.bounds();
  print_report({{"map", command.out.string()},
                {"size_cells", {box.width(), box.height()}},
                {"landmarks", landmarks},
                {"routes", routes},
                {"joined_landmarks", merged.joined_landmarks},
                {"joined_routes", merged.joined_routes},
                {"warnings", merged.warnings}},
               fmt::format("wrote {}: {} x {} cells, {}, {}; {} and {} of the second map are also in the first",
                           command.out.string(), box.width(), box.height(), counted(landmarks, "landmark"),
                           counted(routes, "route"), counted(merged.joined_landmarks, "landmark"),
                           counted(merged.joined_routes, "route")),
               merged.warnings, common);
  return kExitDone;
}

}  // namespace cairn
