#include "framework/templates/template_cache.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "framework/modules/cache_folder.hpp"
#include "framework/modules/module_library.hpp"
#include "framework/templates/sensed_templates.hpp"
#include "maps/base/fingerprint.hpp"

namespace cairn {
namespace {

constexpr std::string_view kMagic = "cairn templates 2\n";

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <class Value>
void put(std::string& out, const Value& value) {
  char bytes[sizeof(Value)];
  std::memcpy(bytes, &value, sizeof(Value));
  out.append(bytes, sizeof(Value));
}

// Takes values off the front; says when there are too few bytes.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class Value>
  [[nodiscard]] bool take(Value& value) {
    if (bytes_.size() < sizeof(Value)) return false;
    std::memcpy(&value, bytes_.data(), sizeof(Value));
    bytes_.remove_prefix(sizeof(Value));
    return true;
  }
  [[nodiscard]] bool take_text(std::string_view text) {
    if (!bytes_.starts_with(text)) return false;
    bytes_.remove_prefix(text.size());
    return true;
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

std::string encoded(const std::string& key, const std::vector<LandmarkTemplate>& templates) {
  std::string out(kMagic);
  put(out, std::uint64_t{key.size()});
  out += key;
  put(out, std::uint64_t{templates.size()});
  for (const LandmarkTemplate& t : templates) {
    put(out, t.orientation_rad);
    put(out, t.tolerance);
    put(out, std::uint64_t{t.category.size()});
    out += t.category;
    put(out, std::uint64_t{t.cells.size()});
    for (const TemplateCell& cell : t.cells) {
      put(out, cell.offset);
      put(out, cell.gradient_x);
      put(out, cell.gradient_y);
    }
  }
  put(out, hash_of(out));
  return out;
}

bool take_template(Reader& in, const std::string& category, LandmarkTemplate& t) {
  std::uint64_t cells = 0;
  std::uint64_t length = 0;
  if (!in.take(t.orientation_rad) || !in.take(t.tolerance) || !in.take(length) || !in.take_text(category) ||
      !in.take(cells))
    return false;
  if (length != category.size() || cells > in.left()) return false;
  t.category = category;
  t.cells.resize(cells);
  for (TemplateCell& cell : t.cells) {
    if (!in.take(cell.offset) || !in.take(cell.gradient_x) || !in.take(cell.gradient_y)) return false;
  }
  return true;
}

std::optional<std::vector<LandmarkTemplate>> decoded(std::string_view bytes, const std::string& key) {
  std::uint64_t sum = 0;
  if (bytes.size() < sizeof(sum)) return std::nullopt;
  const std::string_view body = bytes.substr(0, bytes.size() - sizeof(sum));
  std::memcpy(&sum, bytes.data() + body.size(), sizeof(sum));
  if (sum != hash_of(body)) return std::nullopt;
  Reader in(body);
  std::uint64_t key_size = 0;
  std::uint64_t count = 0;
  if (!in.take_text(kMagic) || !in.take(key_size) || key_size != key.size() || !in.take_text(key) || !in.take(count))
    return std::nullopt;
  // The key begins with the category.
  const std::string category = key.substr(0, key.find('\n'));
  std::vector<LandmarkTemplate> templates;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (!take_template(in, category, templates.emplace_back())) return std::nullopt;
  }
  return in.left() == 0 && count > 0 ? std::optional(std::move(templates)) : std::nullopt;
}

// Key text: every value exactly, one after the other.
class KeyText {
 public:
  KeyText() { out_ << std::hexfloat; }
  template <class... Values>
  KeyText& add(const Values&... values) {
    ((out_ << values << ' '), ...);
    return *this;
  }
  KeyText& add_pose(const Pose2& pose) { return add(pose.x_m, pose.y_m, pose.theta_rad); }
  KeyText& add_points(const std::vector<Point>& points) {
    add(points.size());
    for (const Point& p : points) add(p.x(), p.y());
    return *this;
  }
  KeyText& add_config(const ConfigValue& value) {
    add(static_cast<int>(value.kind), value.quoted, value.scalar.size(), value.scalar);
    add(value.items.size());
    for (const ConfigValue& item : value.items) add_config(item);
    add(value.entries.size());
    for (const ConfigValue::Entry& entry : value.entries) add(entry.key).add_config(entry.value);
    return *this;
  }
  [[nodiscard]] std::string text() const { return out_.str(); }

 private:
  std::ostringstream out_;
};

void add_robot(KeyText& key, const RobotModel& robot) {
  // Named one by one, so that the compiler objects when a field is added and left out here. No template is rendered of
  // what cameras see.
  const auto& [name, radius_m, polygon_m, v, w, a, wa, turning_m, kinematics, sonars, order, period_s, lasers, cameras,
               odometry, has_compass, compass, range] = robot;
  key.add(name.size(), name, radius_m, v, w, a, wa, turning_m, static_cast<int>(kinematics), period_s);
  key.add_points(polygon_m).add(sonars.size());
  for (const auto& [T_robot_sonar, half_beam_rad, min_m, max_m] : sonars)
    key.add_pose(T_robot_sonar).add(half_beam_rad, min_m, max_m);
  for (const int sonar : order) key.add(sonar);
  for (const auto& [T_robot_laser, first_rad, last_rad, beams, min_m, max_m, rate_hz, laser_noise_m, laser_noise_ratio,
                    laser_dropped] : lasers)
    key.add_pose(T_robot_laser)
        .add(first_rad, last_rad, beams, min_m, max_m, rate_hz, laser_noise_m, laser_noise_ratio, laser_dropped);
  const auto& [distance, distance_bias, heading] = odometry;
  const auto& [noise_rad, bias_rad, bias_scale_m] = compass;
  const auto& [noise_m, noise_ratio, dropped, crosstalk] = range;
  key.add(distance, distance_bias, heading, has_compass, noise_rad, bias_rad, bias_scale_m, noise_m, noise_ratio,
          dropped, crosstalk);
}

// 0 when it cannot be read.
std::uint64_t hash_of_code(const std::filesystem::path& file) {
  return hash_of_file(file).value_or(FileHash{}).hash;
}

// The code of a module, and of the library that holds this function or that of a contour.
void add_module(KeyText& key, const ModuleLibrary& library, PluginKind kind, const PluginChoice& choice) {
  const ModuleEntry* entry = library.find_of(kind, choice.name);
  const bool has_file = entry != nullptr && entry->plugin != nullptr;
  key.add(choice.name, has_file ? hash_of_code(entry->plugin->file) : 0).add_config(choice.config);
}

void add_library_of(KeyText& key, const void* address) {
  Dl_info info{};
  if (::dladdr(address, &info) != 0) key.add(hash_of_code(info.dli_fname));
}

}  // namespace

std::filesystem::path TemplateCache::file_of(const std::string& key) const {
  return folder_ / fmt::format("{:x}.templates", hash_of(key));
}

std::optional<std::vector<LandmarkTemplate>> TemplateCache::find(const std::string& key) const {
  return folder_.empty() ? std::nullopt : decoded(bytes_of(file_of(key)), key);
}

void TemplateCache::keep(const std::string& key, const std::vector<LandmarkTemplate>& templates) const {
  if (folder_.empty()) return;
  keep_in_cache(file_of(key), encoded(key, templates));
}

std::filesystem::path template_cache_folder() {
  return cache_folder("CAIRN_TEMPLATE_CACHE", "templates");
}

std::string rendering_key(double step_rad, double cell_m, const SensedOptions& options, const RobotModel& robot,
                          const PluginChoice& sensor, const PluginChoice& map, const ModuleLibrary& library) {
  KeyText key;
  const auto& [sizes, smooth_too, smooth_tolerance, gaps_m, speed_mps, inside, outside, min_gradient, seed] = options;
  key.add(step_rad, cell_m, speed_mps, inside, outside, min_gradient, seed, smooth_too, smooth_tolerance, gaps_m.size(),
          sizes.size());
  for (const double size : sizes) key.add(size);
  for (const double gap_m : gaps_m) key.add(gap_m);
  add_robot(key, robot);
  add_module(key, library, PluginKind::sensor, sensor);
  add_module(key, library, PluginKind::map, map);
  const auto rendering = &distinct_orientations;
  const auto driving = &template_cache_folder;
  add_library_of(key, reinterpret_cast<const void*>(rendering));
  add_library_of(key, reinterpret_cast<const void*>(driving));
  return key.text();
}

std::string shape_key(const std::string& rendering_key, const LandmarkShape& shape) {
  KeyText key;
  key.add(shape.contour.circle_diameter_m, shape.contour.polygons_m.size());
  for (const std::vector<Point>& corners : shape.contour.polygons_m) key.add_points(corners);
  return shape.category + "\n" + key.text() + rendering_key;
}

}  // namespace cairn
