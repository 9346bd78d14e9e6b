#include "plugins/april_tags/config.hpp"

#include <span>
#include <string>
#include <utility>

namespace cairn::april_tags {
namespace {

std::vector<std::pair<std::string, MarkerFamily>> named_families() {
  std::vector<std::pair<std::string, MarkerFamily>> named;
  for (const MarkerFamily family : kMarkerFamilies) named.emplace_back(name_of(family), family);
  return named;
}

}  // namespace

void SizeConfig::describe(Fields<SizeConfig>& fields) {
  fields.choice("family", &SizeConfig::family, named_families(), "which AprilTags they are of");
  fields.integer("first", &SizeConfig::first, {0, 2114}, "the lowest of their ids").required = true;
  fields.integer("last", &SizeConfig::last, {0, 2114}, "the highest of their ids").required = true;
  fields.number("size_m", &SizeConfig::size_m, {0.005, 5.0}, "m", "how large they are printed").required = true;
}

void Config::describe(Fields<Config>& fields) {
  fields.choices("families", &Config::families, named_families(), "which AprilTags are looked for; left out: 36h11");
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

void check_sizes(const Config& config) {
  for (const SizeConfig& size : config.sizes) {
    const std::string tags = "sizes: " + std::to_string(size.first) + " to " + std::to_string(size.last);
    if (size.last < size.first) throw ConfigError({}, tags + ": last is below first");
    if (const std::string fault = number_fault(size.last, std::span(&size.family, 1)); !fault.empty())
      throw ConfigError({}, tags + ": there are no such tags: " + fault);
  }
}

double size_of(const Config& config, const MarkerId& marker) {
  for (const SizeConfig& size : config.sizes)
    if (size.family == marker.family && size.first <= marker.number && marker.number <= size.last) return size.size_m;
  return config.size_m;
}

}  // namespace cairn::april_tags
