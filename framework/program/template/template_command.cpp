#include <fmt/format.h>

#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "framework/files/robot_file.hpp"
#include "framework/files/template_file.hpp"
#include "framework/mission/modules.hpp"
#include "framework/modules/fence.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/output_files.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/text.hpp"
#include "maps/pictures/template_sheet.hpp"

namespace cairn {
namespace {

PluginChoice plain(const std::string& name) {
  PluginChoice choice{name, {}};
  choice.config.kind = ConfigValue::Kind::map;
  choice.config.place.file = name;
  return choice;
}

}  // namespace

// Nothing but templates: the robot, the simulator and the default mapper.
Mission template_mission(const TemplateCommand& command, const std::string& what) {
  Mission mission;
  mission.shapes = load_landmark_shapes(command.folder);
  mission.template_settings.step_rad = radians(command.step_deg);
  mission.template_settings.rendering = command.rendering == "ideal" ? Rendering::ideal : Rendering::sensed;
  if (mission.template_settings.rendering == Rendering::sensed) {
    if (command.robot.empty()) throw std::runtime_error("template " + what + ": sensed templates need --robot FILE");
    mission.robot = load_robot(command.robot);
  }
  mission.config.sensor = plain("simulated_robot");
  mission.config.map = plain("muriel");
  apply_override(mission.config.map.config, fmt::format("cell_m={}", command.cell_m));
  return mission;
}

int template_list(const TemplateCommand& command, const CommonOptions& common) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [file, outline, shape] : load_template_files(command.folder)) {
    const std::size_t orientations =
        distinct_orientations(shape.contour, radians(command.step_deg), command.cell_m).size();
    if (common.json)
      list.push_back({{"category", shape.category},
                      {"file", file.string()},
                      {"outline", outline},
                      {"diameter_m", shape.contour.outer_diameter_m()},
                      {"orientations", orientations}});
    else
      std::cout << fmt::format("{:<16} {:<9} diameter {:.2f} m, {} at {:g} degree steps\n", shape.category, outline,
                               shape.contour.outer_diameter_m(), counted(orientations, "orientation"),
                               command.step_deg);
  }
  if (common.json) print_json({{"templates", list}});
  return kExitDone;
}

int template_preview(const TemplateCommand& command, const CommonOptions& common) {
  const std::filesystem::path picture = file_to_write(command.picture, "templates.png");
  const Mission mission = template_mission(command, "preview");
  const ModuleLibrary library = module_library(common);
  const TemplateSet set =
      fenced_making(mission.config.map.name, [&] { return render_templates(mission, command.cell_m, library); });
  write_template_sheet(picture, set, command.folder.string() + ", " + command.rendering);
  print({{"picture", picture.string()}, {"templates", set.templates.size()}},
        fmt::format("wrote {} templates to {}\n", set.templates.size(), picture.string()), common);
  return kExitDone;
}

}  // namespace cairn
