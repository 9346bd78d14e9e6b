#include "framework/files/map_server_file.hpp"

#include <algorithm>
#include <cmath>

#include "framework/config/fields.hpp"
#include "maps/base/source_text.hpp"

namespace cairn {
namespace {

struct MapServerConfig {
  std::filesystem::path image;
  double resolution_m = 0.05;
  std::vector<double> origin;
  ConfigValue negate;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
  MapServerMode mode = MapServerMode::trinary;
  static void describe(Fields<MapServerConfig>& fields) {
    fields.file("image", &MapServerConfig::image, "the picture").required = true;
    fields.number("resolution", &MapServerConfig::resolution_m, {0.001, 1000.0}, "m", "side of a pixel").required =
        true;
    fields.numbers("origin", &MapServerConfig::origin, {-1e5, 1e5}, "m", "[x, y, yaw] of the lower left corner")
        .required = true;
    fields.raw("negate", &MapServerConfig::negate, "flag", "1 when white is occupied, else 0").required = true;
    fields.number("occupied_thresh", &MapServerConfig::occupied_thresh, {0.0, 1.0}, "", "occupied from here on")
        .required = true;
    fields.number("free_thresh", &MapServerConfig::free_thresh, {0.0, 1.0}, "", "free up to here").required = true;
    fields.choice("mode", &MapServerConfig::mode,
                  {{"trinary", MapServerMode::trinary}, {"scale", MapServerMode::scale}, {"raw", MapServerMode::raw}},
                  "what greys mean");
  }
};

bool negate_of(const ConfigValue& value) {
  const bool is_plain = value.kind == ConfigValue::Kind::scalar && !value.quoted;
  if (is_plain && (value.scalar == "1" || value.scalar == "true")) return true;
  if (is_plain && (value.scalar == "0" || value.scalar == "false")) return false;
  throw ConfigError(value.place,
                    "negate must be 0, 1, true or false, found " +
                        (value.kind == ConfigValue::Kind::scalar ? in_quotes(value.scalar) : value.kind_name()));
}

Pose2 origin_of(const std::vector<double>& origin, const ConfigValue& value) {
  if (origin.size() != 3)
    throw ConfigError(value.place, "origin must be [x, y, yaw], found a list of " + std::to_string(origin.size()));
  return {origin[0], origin[1], wrap_angle(origin[2])};
}

// map_server writes resolutions with three decimals, whatever they were.
void warn_of_rounding(double resolution_m, const ConfigValue& value, std::vector<std::string>& warnings) {
  const std::size_t dot = value.scalar.find('.');
  const bool has_three = dot != std::string::npos && value.scalar.size() == dot + 4;
  if (!has_three || value.scalar.back() == '0' || value.scalar.back() == '5') return;
  const double error_percent = std::round(1000.0 * 0.0005 / resolution_m) / 10.0;
  warnings.push_back(value.place.text() + ": resolution " + value.scalar +
                     ": map_server saves three decimals only, so it may be up to " +
                     exchange::number_text(error_percent) + " % off");
}

bool lies_in(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const std::filesystem::path within = file.lexically_relative(folder);
  return !within.empty() && std::ranges::find(within, std::filesystem::path("..")) == within.end();
}

// As the path is written, and where its links lead: an archive may hold both the file and the link.
void check_own_folder(const MapServerFile& file, const std::filesystem::path& yaml) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::absolute(yaml).parent_path();
  const fs::path picture = fs::absolute(file.picture);
  if (lies_in(folder.lexically_normal(), picture.lexically_normal()) &&
      lies_in(fs::weakly_canonical(folder), fs::weakly_canonical(picture)))
    return;
  throw ConfigError(file.picture_place, "image: " + in_quotes(file.picture.string()) +
                                            " is outside the folder of the map; --allow-outside reads it all the same");
}

// The picture as it is named, or compressed by gzip beside it. One that is not there is the YAML file's mistake.
std::string text_of_picture(const MapServerFile& file) {
  std::filesystem::path compressed = file.picture;
  compressed += ".gz";
  const bool is_compressed = !std::filesystem::exists(file.picture) && std::filesystem::exists(compressed);
  try {
    return exchange::text_of_file(is_compressed ? compressed : file.picture);
  } catch (const ExchangeError& error) {
    throw ConfigError(file.picture_place, std::string("image: ") + error.what());
  }
}

}  // namespace

MapServerFile parse_map_server_yaml(const std::string& text, const std::string& file_name) {
  const ConfigValue root = parse_config_text(text, file_name);
  const auto config = load_config<MapServerConfig>(root, "the map");
  MapServerFile file;
  file.picture = config.image;
  file.picture_place = root.find("image")->place;
  MapServerSettings& settings = file.settings;
  settings.mode = config.mode;
  settings.resolution_m = config.resolution_m;
  settings.origin = origin_of(config.origin, *root.find("origin"));
  settings.negate = negate_of(config.negate);
  settings.occupied_thresh = config.occupied_thresh;
  settings.free_thresh = config.free_thresh;
  if (settings.free_thresh > settings.occupied_thresh)
    throw ConfigError(root.find("free_thresh")->place, "free_thresh must not be above occupied_thresh, found " +
                                                           config_detail::number_text(settings.free_thresh) + " and " +
                                                           config_detail::number_text(settings.occupied_thresh));
  warn_of_rounding(settings.resolution_m, *root.find("resolution"), file.warnings);
  return file;
}

ImportedGrid load_map_server(const std::filesystem::path& file, PictureFolder pictures) {
  MapServerFile server = parse_map_server_yaml(exchange::text_of_file(file), file.string());
  if (pictures == PictureFolder::own) check_own_folder(server, file);
  const std::string picture = server.picture.string();
  ImportedGrid imported = grid_of(parse_grey_picture(text_of_picture(server), picture), server.settings, picture);
  for (std::string& warning : imported.warnings) warning.insert(0, file.string() + ": ");
  imported.warnings.insert(imported.warnings.begin(), server.warnings.begin(), server.warnings.end());
  return imported;
}

}  // namespace cairn
