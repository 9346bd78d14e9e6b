#include "framework/files/template_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "framework/config/fields.hpp"
#include "maps/landmarks/outline.hpp"

namespace cairn {
namespace {

constexpr std::size_t kLongestCategory = 64;
constexpr Range kSize_m{0.01, 100.0};

struct CircleConfig {
  double diameter_m = 0.0;
  static void describe(Fields<CircleConfig>& fields) {
    fields.number("diameter_m", &CircleConfig::diameter_m, kSize_m, "m", "how wide it is").required = true;
  }
};

struct PictureConfig {
  std::filesystem::path file;
  double cell_m = 0.01;
  static void describe(Fields<PictureConfig>& fields) {
    fields.file("file", &PictureConfig::file, "a PNG, the landmark dark on light or light on dark").required = true;
    fields.number("cell_m", &PictureConfig::cell_m, {1e-4, 1.0}, "m", "how wide one of its pixels is").required = true;
  }
};

constexpr const char* kBulgesMeaning =
    "arcs in place of polygon_m's sides, one number a side, from the first corner on: the tangent of a quarter of "
    "the arc's angle, 0 straight, 1 half a circle; outward when the corners go anticlockwise";

// One of several outlines, in the landmark's own frame.
struct PartConfig {
  CircleConfig circle;
  std::vector<Point> polygon_m;
  std::vector<double> bulges;
  Point at_m{0.0, 0.0};
  static void describe(Fields<PartConfig>& fields) {
    fields.group("circle", &PartConfig::circle, "a round part");
    fields.points("polygon_m", &PartConfig::polygon_m, "m", "the corners of any other part");
    fields.numbers("bulges", &PartConfig::bulges, {-10.0, 10.0}, "", kBulgesMeaning);
    fields.point("at_m", &PartConfig::at_m, "m", "where the part's own origin is in the landmark's frame");
    fields.one_of({"circle", "polygon_m"});
  }
};

struct TemplateConfig {
  std::string category;
  CircleConfig circle;
  std::vector<Point> polygon_m;
  std::vector<double> bulges;
  std::vector<PartConfig> parts;
  PictureConfig picture;
  static void describe(Fields<TemplateConfig>& fields) {
    fields.text("category", &TemplateConfig::category, "what landmarks of this shape are called").required = true;
    fields.group("circle", &TemplateConfig::circle, "a round shape");
    fields.points("polygon_m", &TemplateConfig::polygon_m, "m",
                  "the corners of any other shape, in a frame of its own");
    fields.numbers("bulges", &TemplateConfig::bulges, {-10.0, 10.0}, "", kBulgesMeaning);
    fields.list("parts", &TemplateConfig::parts, "several outlines apart from each other: posts, legs");
    fields.group("picture", &TemplateConfig::picture, "the outline of what a picture shows");
    fields.one_of({"circle", "polygon_m", "parts", "picture"});
  }
};

// Categories stand in commands ("nearest square"), in tables and in file names.
// What make() gives; its objections get the place of the key that they are about.
template <class Make>
auto at_key(const ConfigValue& map, const std::string& key, Make make) {
  try {
    return make();
  } catch (const std::invalid_argument& error) {
    throw ConfigError(map.find(key)->place, key + ": " + error.what());
  }
}

// Config: TemplateConfig or PartConfig.
template <class Config>
std::vector<Point> polygon_of(const Config& config, const ConfigValue& value) {
  if (value.find("bulges") == nullptr) return config.polygon_m;
  if (value.find("polygon_m") == nullptr)
    throw ConfigError(value.find("bulges")->place, "bulges bend the sides of polygon_m, which is not here");
  return at_key(value, "bulges", [&] { return with_arcs(config.polygon_m, config.bulges); });
}

// A round part as half circles.
std::vector<Point> round_polygon(double diameter_m) {
  const double r = diameter_m / 2.0;
  return with_arcs(std::vector<Point>{{r, 0.0}, {-r, 0.0}}, std::vector<double>{1.0, 1.0});
}

Contour contour_of_parts(const TemplateConfig& config, const ConfigValue& root) {
  std::vector<std::vector<Point>> polygons;
  for (std::size_t i = 0; i < config.parts.size(); ++i) {
    const PartConfig& part = config.parts[i];
    const ConfigValue& value = root.find("parts")->items[i];
    const bool is_round = config_detail::exactly_one_of(value, {"circle", "polygon_m"}, "a part") == "circle";
    std::vector<Point> corners = polygon_of(part, value);
    if (is_round) corners = round_polygon(part.circle.diameter_m);
    for (Point& corner : corners) corner += part.at_m;
    if (!is_round) at_key(value, "polygon_m", [&] { return Contour::polygon_in_place(corners); });
    polygons.push_back(std::move(corners));
  }
  return at_key(root, "parts", [&] { return Contour::parts(std::move(polygons)); });
}

Contour contour_of(const TemplateConfig& config, const std::string& outline, const ConfigValue& root) {
  if (outline == "parts") {
    if (const ConfigValue* bulges = root.find("bulges"))
      throw ConfigError(bulges->place, "bulges belong to the part that they bend");
    return contour_of_parts(config, root);
  }
  const std::vector<Point> corners = polygon_of(config, root);
  return at_key(root, outline, [&] {
    if (outline == "circle") return Contour::circle(config.circle.diameter_m);
    if (outline == "picture") return contour_in_picture(config.picture.file, config.picture.cell_m);
    return Contour::polygon(corners);
  });
}

LandmarkShape shape_of(const ConfigValue& root) {
  const auto config = load_config<TemplateConfig>(root, "template");
  check_category(config.category, root.find("category")->place);
  const std::string outline = config_detail::exactly_one_of(root, template_file_schema().one_of, "template");
  LandmarkShape shape{config.category, contour_of(config, outline, root)};
  const double diameter_m = shape.contour.outer_diameter_m();
  if (diameter_m < kSize_m.min || diameter_m > kSize_m.max)
    throw ConfigError(root.find(outline)->place, outline + " must be from " + config_detail::number_text(kSize_m.min) +
                                                     " to " + config_detail::number_text(kSize_m.max) +
                                                     " m across, is " + config_detail::number_text(diameter_m) + " m");
  return shape;
}

// The template files of a folder in the order of their names.
std::vector<std::filesystem::path> template_files(const std::filesystem::path& folder) {
  const SourcePlace place{folder.string(), 0, 0};
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) throw ConfigError(place, "no such folder of templates");
  if (!std::filesystem::is_directory(folder, error)) throw ConfigError(place, "a file, not a folder of templates");
  std::vector<std::filesystem::path> files;
  for (auto at = std::filesystem::directory_iterator(folder, error);
       !error && at != std::filesystem::directory_iterator(); at.increment(error)) {
    const std::filesystem::path& file = at->path();
    if (file.extension() == ".yaml" && !file.filename().string().starts_with('.')) files.push_back(file);
  }
  if (error) throw ConfigError(place, "cannot be read: " + error.message());
  if (files.empty()) throw ConfigError(place, "no template in this folder; a template is a file *.yaml");
  if (files.size() > kMaxTemplateFiles)
    throw ConfigError(place, "holds " + std::to_string(files.size()) + " templates; at most " +
                                 std::to_string(kMaxTemplateFiles) + " categories can be distinguished at a time");
  std::ranges::sort(files);
  return files;
}

std::string corners_text(const std::vector<Point>& corners) {
  std::string text;
  for (const Point& p : corners) text += fmt::format("{}[{:.3f}, {:.3f}]", text.empty() ? "" : ", ", p.x(), p.y());
  return "[" + text + "]";
}

}  // namespace

Schema template_file_schema() {
  return schema_of<TemplateConfig>();
}

void check_category(const std::string& category, const SourcePlace& place) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_allowed = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
  const bool is_good = !category.empty() && category.size() <= kLongestCategory && is_letter(category.front()) &&
                       std::ranges::all_of(category, is_allowed);
  if (is_good) return;
  throw ConfigError(place, "category must be a letter and up to " + std::to_string(kLongestCategory - 1) +
                               " letters, digits, _ or -, found " + in_quotes(category));
}

std::string template_text(const std::string& category, const CapturedOutline& captured, const std::string& of) {
  std::string text = fmt::format("# Captured at ({:.2f}, {:.2f}) m of {}; at 0 deg it stands as it stands there.\n",
                                 captured.at_m.x(), captured.at_m.y(), of);
  text += "category: " + category + "\n";
  const std::vector<std::vector<Point>>& polygons = captured.contour.polygons_m;
  if (polygons.size() == 1) return text + "polygon_m: " + corners_text(polygons.front()) + "\n";
  text += "parts:\n";
  for (const std::vector<Point>& corners : polygons) text += "  - {polygon_m: " + corners_text(corners) + "}\n";
  return text;
}

LandmarkShape parse_landmark_shape(const std::string& text, const std::string& file_name) {
  return shape_of(parse_config_text(text, file_name));
}

LandmarkShape load_landmark_shape(const std::filesystem::path& file) {
  return shape_of(read_config_file(file));
}

std::vector<TemplateFile> load_template_files(const std::filesystem::path& folder) {
  std::vector<TemplateFile> templates;
  std::map<std::string, std::string> file_of_category;
  for (const std::filesystem::path& file : template_files(folder)) {
    const ConfigValue root = read_config_file(file);
    const std::string outline = config_detail::exactly_one_of(root, template_file_schema().one_of, "template");
    templates.push_back({file, outline == "polygon_m" ? "polygon" : outline, shape_of(root)});
    const std::string& category = templates.back().shape.category;
    const auto [first, is_new] = file_of_category.emplace(category, file.string());
    if (!is_new) {
      throw ConfigError(root.find("category")->place,
                        "the category " + in_quotes(category) + " is taken by " + first->second);
    }
  }
  std::ranges::sort(templates, {}, [](const TemplateFile& one) -> const std::string& { return one.shape.category; });
  return templates;
}

std::vector<LandmarkShape> load_landmark_shapes(const std::filesystem::path& folder) {
  std::vector<LandmarkShape> shapes;
  for (TemplateFile& one : load_template_files(folder)) shapes.push_back(std::move(one.shape));
  return shapes;
}

}  // namespace cairn
