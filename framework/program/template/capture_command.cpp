#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/files/template_file.hpp"
#include "framework/planning/place.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/common/refusal.hpp"
#include "maps/base/output_file.hpp"
#include "maps/base/text.hpp"
#include "maps/landmarks/captured_outline.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {
namespace {

Point place_in(const SavedMap& map, const std::string& text) {
  const Place place = parse_place(text, map.graph);
  if (place.pose) return place.pose->position();
  if (place.landmarks.size() != 1)
    throw std::runtime_error(fmt::format("template capture: --at \"{}\" is {} landmarks; name one, such as L{}", text,
                                         place.landmarks.size(), place.landmarks.front()));
  return map.graph.find(place.landmarks.front())->T_map_landmark.position();
}

// Leaves no file behind that would not load.
LandmarkShape write_template(const std::filesystem::path& file, const std::string& text) {
  if (std::filesystem::exists(std::filesystem::symlink_status(file)))
    throw std::runtime_error(file.string() + ": there is such a file already");
  write_file(file, text);
  try {
    return load_landmark_shape(file);
  } catch (...) {
    std::filesystem::remove(file);
    throw;
  }
}

}  // namespace

int template_capture(const CaptureCommand& command, const CommonOptions& common) {
  const SavedMap map = load_map(command.map);
  const CapturedOutline captured = refused_about(
      command.map.string(), [&] { return captured_outline(map.grid, place_in(map, command.at), command.radius_m); });
  const LandmarkShape shape =
      write_template(command.out, template_text(command.category, captured, command.map.filename().string()));
  const double diameter_m = shape.contour.outer_diameter_m();
  const std::size_t parts = shape.contour.polygons_m.size();
  print({{"file", command.out.string()},
         {"category", shape.category},
         {"x_m", captured.at_m.x()},
         {"y_m", captured.at_m.y()},
         {"diameter_m", diameter_m},
         {"parts", parts}},
        fmt::format("wrote {}: {}, {:.2f} m across, {}\n"
                    "It is what lies within {:g} m, as large as the sensors saw it: correct it by hand where you know "
                    "better{}.\n",
                    command.out.string(), shape.category, diameter_m, counted(parts, "part"), command.radius_m,
                    parts == 1 ? "" : ", or take fewer things with a smaller --radius-m"),
        common);
  return kExitDone;
}

}  // namespace cairn
