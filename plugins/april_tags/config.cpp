#include "plugins/april_tags/config.hpp"

#include "maps/base/text.hpp"

namespace cairn::april_tags {

void SizeConfig::describe(Fields<SizeConfig>& fields) {
  fields.choice("family", &SizeConfig::family,
                {{"36h11", MarkerFamily::tag36h11},
                 {"25h9", MarkerFamily::tag25h9},
                 {"standard41h12", MarkerFamily::tagStandard41h12}},
                "which AprilTags they are of");
  fields.integer("first", &SizeConfig::first, {0, 2114}, "the lowest of their ids").required = true;
  fields.integer("last", &SizeConfig::last, {0, 2114}, "the highest of their ids").required = true;
  fields.number("size_m", &SizeConfig::size_m, {0.005, 5.0}, "m", "how large they are printed").required = true;
}

void Config::describe(Fields<Config>& fields) {
  fields.texts("families", &Config::families,
               "which AprilTags are looked for: 36h11 (when left out), 25h9, "
               "standard41h12");
  fields.number("size_m", &Config::size_m, {0.005, 5.0}, "m",
                "how large the tags are printed: side of the square whose corners are detected; of 36h11 and 25h9 the "
                "black border's outside, of standard41h12 the white border's outside");
  fields.list("sizes", &Config::sizes, "tags that are printed in another size");
  fields.number("decimate", &Config::decimate, {1.0, 8.0}, "",
                "squares are searched for in a picture that is smaller by this factor: 2 is faster by two to three "
                "times and sees tags half as far");
  fields.integer("threads", &Config::threads, {1, 64}, "threads that a picture is worked on with");
  fields.number("min_decision_margin", &Config::min_decision_margin, {0.0, 255.0}, "",
                "tags whose black and white cells differ by less, in grey levels, are ignored");
  fields.number("corner_noise_px", &Config::corner_noise_px, {0.001, 10.0}, "px",
                "error of a corner in a picture, standard deviation; more when a tag's corners fit worse than that");
  fields.number("min_position_error_m", &Config::min_position_error_m, {0.0, 1.0}, "m",
                "standard deviation of a tag's position, at least: by the camera's mounting and the print");
  fields.angle("min_angle_error_deg", &Config::min_angle_error_rad, {0.0, 45.0},
               "standard deviation of a tag's direction, at least");
}

std::vector<MarkerFamily> families_of(const Config& config) {
  std::vector<MarkerFamily> families;
  families.reserve(config.families.size());
  const auto known = [] {
    std::vector<std::string> names;
    for (const MarkerFamily family : kMarkerFamilies) names.emplace_back(name_of(family));
    return names;
  };
  for (const std::string& name : config.families) {
    const auto* const found =
        std::ranges::find_if(kMarkerFamilies, [&](MarkerFamily family) { return name_of(family) == name; });
    if (found == std::end(kMarkerFamilies))
      throw ConfigError({}, "families: unknown family " + in_quotes(name) + did_you_mean(name, known()) +
                                "; known are: " + joined(known()));
    if (std::ranges::find(families, *found) == families.end()) families.push_back(*found);
  }
  if (families.empty()) throw ConfigError({}, "families must name one at least; known are: " + joined(known()));
  return families;
}

double size_of(const Config& config, const MarkerId& marker) {
  for (const SizeConfig& size : config.sizes)
    if (size.family == marker.family && size.first <= marker.number && marker.number <= size.last) return size.size_m;
  return config.size_m;
}

}  // namespace cairn::april_tags
