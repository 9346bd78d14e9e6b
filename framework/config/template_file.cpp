#include "framework/config/template_file.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "framework/config/fields.hpp"

namespace cairn {
namespace {

constexpr std::size_t kLongestCategory = 64;

struct CircleConfig {
  double diameter_m = 0.0;
  static void describe(Fields<CircleConfig>& fields) {
    fields.number("diameter_m", &CircleConfig::diameter_m, {0.01, 100.0}, "m", "how wide it is").required = true;
  }
};

struct TemplateConfig {
  std::string category;
  CircleConfig circle;
  std::vector<Point> polygon_m;
  static void describe(Fields<TemplateConfig>& fields) {
    fields.text("category", &TemplateConfig::category, "what landmarks of this shape are called").required = true;
    fields.group("circle", &TemplateConfig::circle, "a round shape");
    fields.points("polygon_m", &TemplateConfig::polygon_m, "m",
                  "the corners of any other shape, in a frame of its own");
    fields.one_of({"circle", "polygon_m"});
  }
};

// Categories stand in commands ("nearest square"), in tables and in file names.
void check_category(const std::string& category, const SourcePlace& place) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_allowed = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
  const bool is_good = !category.empty() && category.size() <= kLongestCategory && is_letter(category.front()) &&
                       std::ranges::all_of(category, is_allowed);
  if (is_good) return;
  throw ConfigError(place, "category must be a letter and up to " + std::to_string(kLongestCategory - 1) +
                               " letters, digits, _ or -, found " + shown(category));
}

LandmarkShape shape_of(const ConfigValue& root) {
  const auto config = load_config<TemplateConfig>(root, "template");
  check_category(config.category, root.find("category")->place);
  const std::string outline = config_detail::exactly_one_of(root, template_file_schema().one_of, "template");
  try {
    return {config.category,
            outline == "circle" ? Contour::circle(config.circle.diameter_m) : Contour::polygon(config.polygon_m)};
  } catch (const std::invalid_argument& error) {
    throw ConfigError(root.find(outline)->place, outline + ": " + error.what());
  }
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
  std::ranges::sort(files);
  return files;
}

}  // namespace

Schema template_file_schema() {
  return schema_of<TemplateConfig>();
}

LandmarkShape load_landmark_shape(const std::filesystem::path& file) {
  return shape_of(read_config_file(file));
}

std::vector<LandmarkShape> load_landmark_shapes(const std::filesystem::path& folder) {
  std::vector<LandmarkShape> shapes;
  std::map<std::string, std::string> file_of_category;
  for (const std::filesystem::path& file : template_files(folder)) {
    const ConfigValue root = read_config_file(file);
    shapes.push_back(shape_of(root));
    const std::string& category = shapes.back().category;
    const auto [first, is_new] = file_of_category.emplace(category, file.string());
    if (!is_new) {
      throw ConfigError(root.find("category")->place,
                        "the category " + shown(category) + " is taken by " + first->second);
    }
  }
  std::ranges::sort(shapes, {}, &LandmarkShape::category);
  return shapes;
}

}  // namespace cairn
