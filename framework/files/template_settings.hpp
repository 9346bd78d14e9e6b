// The settings of every detector that looks for landmark templates. The host reads them as well: it renders
// the templates that the detector finds in DetectorContext::templates.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/fields.hpp"

namespace cairn {

enum class Rendering { sensed, ideal };

struct TemplateSettings {
  std::filesystem::path templates;
  Rendering rendering = Rendering::sensed;
  double step_rad = radians(15.0);
  std::vector<double> sizes{1.0};
  bool smooth_too = false;
  double smooth_tolerance = 1.2;
  double ring_offset_m = 0.04;  // where sonar maps show the outline (docs/results/paper.md)
  static void describe(Fields<TemplateSettings>& fields);
};

// For the describe() of a detector's own settings, which have these as a base.
template <class Config>
void describe_templates(Fields<Config>& fields) {
  // A base's member is a member of Config, but not by the type that Fields deduces.
  std::filesystem::path Config::*const templates = &Config::templates;
  Rendering Config::*const rendering = &Config::rendering;
  std::vector<double> Config::*const sizes = &Config::sizes;
  bool Config::*const smooth_too = &Config::smooth_too;
  fields.file("templates", templates, "folder of template files; the host renders them for the mission");
  fields.choice("rendering", rendering, {{"sensed", Rendering::sensed}, {"ideal", Rendering::ideal}},
                "how templates are made: as the mission's own sensor and mapper would see them, or drawn");
  fields.angle("step_deg", &Config::step_rad, {1.0, 90.0}, "orientation step of the templates");
  fields.numbers("sizes", sizes, {0.5, 2.0}, "",
                 "templates are rendered in each of these sizes, as shares of the shape's own; for landmarks whose "
                 "size varies");
  fields.flag(
      "smooth_too", smooth_too,
      "for robots without a laser: sensed templates with straight faces are rendered a second time with a "
      "smooth surface, which echoes only where a beam meets it at a right angle; up to twice the time to match");
  fields.number(
      "smooth_tolerance", &Config::smooth_tolerance, {1.0, 2.0}, "",
      "template_matcher: the mismatch of a smooth template is divided by this where no template fits without it; a "
      "drive through a room shows less of smooth faces than the orbits that they are rendered from");
  fields.number("ring_offset_m", &Config::ring_offset_m, {-0.2, 0.2}, "m",
                "of drawn templates (`rendering: ideal`): how far outside the outline the ring is drawn, as maps of "
                "sonars show it; 0: on the outline, as in the paper");
}

inline void TemplateSettings::describe(Fields<TemplateSettings>& fields) {
  describe_templates(fields);
}

}  // namespace cairn
