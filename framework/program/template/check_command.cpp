#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/mission/modules.hpp"
#include "framework/modules/fence.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/print.hpp"
#include "framework/templates/template_check.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

constexpr int kMaxCoarseCells = 5;

// As coarse as missions have it, and as the smallest landmark allows.
PluginChoice detector_for(const TemplateSet& set, const std::string& degrees) {
  PluginChoice choice{"template_matcher", {}};
  choice.config.kind = ConfigValue::Kind::map;
  const int most = static_cast<int>(std::floor(set.smallest_diameter_m() / set.cell_m + 1e-9));
  apply_override(choice.config, fmt::format("coarse_cells={}", std::clamp(most, 1, kMaxCoarseCells)));
  apply_override(choice.config, "degrees=" + degrees);
  return choice;
}

std::string word_for(const std::string& category) {
  return category.empty() ? "none" : category;
}

ordered_json json_of(const TemplateCheck& check, const TemplateCommand& command) {
  ordered_json confusion = ordered_json::object();
  for (const std::string& shown : check.categories) {
    confusion[shown] = ordered_json::object();
    for (const auto& [found, times] : check.found_for(shown)) confusion[shown][word_for(found)] = times;
  }
  ordered_json views = ordered_json::array();
  for (const TemplateView& view : check.views)
    views.push_back({{"shown", view.shown},
                     {"angle_deg", degrees(view.orientation_rad)},
                     {"found", word_for(view.found)},
                     {"degree", view.degree},
                     {"right_degree", view.right_degree},
                     {"angle_error_deg", degrees(view.orientation_error_rad)}});
  return {{"cell_m", command.cell_m},
          {"step_deg", command.step_deg},
          {"categories", check.categories},
          {"confusion", confusion},
          {"views", views},
          {"advice", check.advice}};
}

void print_matrix(const TemplateCheck& check) {
  std::vector<std::string> columns = check.categories;
  columns.emplace_back();
  std::size_t width = 4;
  for (const std::string& column : columns) width = std::max(width, column.size());
  std::cout << fmt::format("{:<{}}  taken for\n{:<{}}", "shown", width, "", width);
  for (const std::string& column : columns) std::cout << fmt::format("  {:>{}}", word_for(column), width);
  std::cout << "\n";
  for (const std::string& shown : check.categories) {
    std::map<std::string, int> found = check.found_for(shown);
    std::cout << fmt::format("{:<{}}", shown, width);
    for (const std::string& column : columns)
      std::cout << fmt::format("  {:>{}}", found[column] == 0 ? "." : std::to_string(found[column]), width);
    std::cout << "\n";
  }
}

void print_check(const TemplateCheck& check, const TemplateCommand& command) {
  print_matrix(check);
  int right = 0;
  int turned = 0;
  for (const TemplateView& view : check.views) {
    if (view.is_right()) {
      ++right;
      turned += static_cast<int>(degrees(view.orientation_error_rad) <= command.step_deg);
      continue;
    }
    std::cout << fmt::format("{} at {:g} deg: {} ({:.2f}; its own degree {:.2f})\n", view.shown,
                             degrees(view.orientation_rad), word_for(view.found), view.degree, view.right_degree);
  }
  std::cout << fmt::format("{} of {} views right, {} of them within one step of {:g} deg\n", right, check.views.size(),
                           turned, command.step_deg);
  for (const std::string& sentence : check.advice) std::cout << "- " << sentence << "\n";
}

}  // namespace

int template_check(const TemplateCommand& command, const CommonOptions& common) {
  const Mission mission = template_mission(command, "check");
  const ModuleLibrary library = module_library(common);
  const auto set = std::make_shared<const TemplateSet>(
      fenced_making(mission.config.map.name, [&] { return render_templates(mission, command.cell_m, library); }));
  const CheckedDetector detector{detector_for(*set, "above_threshold"), detector_for(*set, "all")};
  const OrbitCrew crew{mission.robot, mission.config.sensor, mission.config.map, library};
  const TemplateCheck check =
      fenced("template check", detector.quick.name, [&] { return check_templates(set, detector, crew); });
  if (common.json)
    print_json(json_of(check, command));
  else
    print_check(check, command);
  return check.has_mistakes() ? kExitNotSolved : kExitDone;
}

}  // namespace cairn
