#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/program/common/print.hpp"
#include "framework/program/map/map_edits.hpp"
#include "maps/base/text.hpp"

namespace cairn {

int template_capture(const CaptureCommand& command, const CommonOptions& common) {
  const auto [shape, at_m] = capture_template(command);
  const double diameter_m = shape.contour.outer_diameter_m();
  const std::size_t parts = shape.contour.polygons_m.size();
  print({{"file", command.out.string()},
         {"category", shape.category},
         {"x_m", at_m.x()},
         {"y_m", at_m.y()},
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
