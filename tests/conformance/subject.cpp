#include "tests/conformance/subject.hpp"

#include "framework/config/config_value.hpp"
#include "framework/files/robot_file.hpp"
#include "tests/conformance/fixtures.hpp"

namespace cairn::conformance {

Setup default_setup(PluginKind kind) {
  Setup setup;
  setup.robot = eight_sonar_robot();
  setup.world = std::make_shared<World>(room());
  setup.T_map_start = kRoomStart;
  setup.landmark_shapes = {{"post", Contour::circle(kPostDiameter_m)}};
  if (kind == PluginKind::detector) setup.templates = std::make_shared<TemplateSet>(three_templates());
  return setup;
}

ModuleSource::ModuleSource(std::vector<std::filesystem::path> folders, std::string name, std::string config_yaml)
    : folders_(std::move(folders)),
      name_(std::move(name)),
      config_yaml_(std::move(config_yaml)),
      shared_(std::make_shared<Shared>()) {}

ModuleSource ModuleSource::also_from(const std::filesystem::path& folder) const {
  std::vector<std::filesystem::path> folders = folders_;
  folders.push_back(folder);
  return {std::move(folders), name_, config_yaml_};
}

PluginChoice ModuleSource::choice() const {
  return {name_, parse_config_text(config_yaml_, "config of " + name_)};
}

std::shared_ptr<const ModuleLibrary> ModuleSource::library() const {
  if (!shared_->library) shared_->library = new_library();
  return shared_->library;
}

std::unique_ptr<const ModuleLibrary> ModuleSource::new_library() const {
  return std::make_unique<const ModuleLibrary>(folders_);
}

std::function<std::shared_ptr<LoopCloser>()> loop_closer_of(const ModuleLibrary* modules,
                                                            const ModuleContext& context) {
  PluginChoice choice{"submap_correlation", {}};
  choice.config.kind = ConfigValue::Kind::map;
  if (modules == nullptr || modules->find_of(PluginKind::loop_closer, choice.name) == nullptr) return {};
  return [modules, context, choice] { return modules->make<LoopCloser>(choice, context); };
}

RobotModel robot_of_file(const std::filesystem::path& file) {
  return load_robot(file);
}

}  // namespace cairn::conformance
