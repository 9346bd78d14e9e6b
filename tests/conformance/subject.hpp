// What a conformance suite is run on: a module of one kind, made as the host makes it.
//
//   module<cairn::Detector>(PLUGIN_FOLDER, "my_detector", "{min_size_m: 0.2}")
//
// loads every module of the folder, as the host does, when the first test makes an object. By default an
// object is made with the robot, world and start of fixtures.hpp and, for a detector, with the ideal templates
// of three simple shapes; what a module needs otherwise is set by the members that return a changed copy.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "framework/contracts/module.hpp"
#include "framework/modules/module_library.hpp"

namespace cairn::conformance {

// What a factory gets besides its config.
struct Setup {
  RobotModel robot;
  std::shared_ptr<const World> world;
  std::shared_ptr<const TemplateSet> templates;
  Pose2 T_map_start;
  std::vector<LandmarkShape> landmark_shapes;        // for localizers
  std::shared_ptr<const OccupancyGrid> grid_so_far;  // for maps; null: none
};

// The robot, world and start of fixtures.hpp; templates for detectors only.
[[nodiscard]] Setup default_setup(PluginKind kind);

// Modules by name from some folders, loaded at the first use.
class ModuleSource {
 public:
  ModuleSource(std::vector<std::filesystem::path> folders, std::string name, std::string config_yaml);

  [[nodiscard]] ModuleSource also_from(const std::filesystem::path& folder) const;
  // Throws ConfigError when the folders hold no such module or the config is refused.
  [[nodiscard]] PluginChoice choice() const;
  [[nodiscard]] std::shared_ptr<const ModuleLibrary> library() const;  // one for all copies
  [[nodiscard]] std::unique_ptr<const ModuleLibrary> new_library() const;

 private:
  struct Shared {
    std::shared_ptr<const ModuleLibrary> library;
  };

  std::vector<std::filesystem::path> folders_;
  std::string name_;
  std::string config_yaml_;
  std::shared_ptr<Shared> shared_;
};

// For localizers: makes Cairn's own loop closer. Empty where the folders do not hold it.
[[nodiscard]] std::function<std::shared_ptr<LoopCloser>()> loop_closer_of(const ModuleLibrary* modules,
                                                                          const ModuleContext& context);

template <class Interface>
class Subject {
 public:
  using Factory = std::function<std::shared_ptr<Interface>(const ContextOf<Interface>&)>;

  // An object that no module file holds; ModuleContext::modules is null.
  Subject(std::string name, Factory factory) : name_(std::move(name)), factory_(std::move(factory)) {}
  Subject(std::string name, ModuleSource source)
      : name_(std::move(name)), source_(std::make_shared<ModuleSource>(std::move(source))) {}

  // Another folder of modules that this one uses (a planner its router).
  [[nodiscard]] Subject also_from(const std::filesystem::path& folder) const {
    Subject copy = *this;
    if (source_) copy.source_ = std::make_shared<ModuleSource>(source_->also_from(folder));
    return copy;
  }
  [[nodiscard]] Subject with_robot(const RobotModel& robot) const {
    return changed([&](Setup& setup) { setup.robot = robot; });
  }
  [[nodiscard]] Subject with_robot_file(const std::filesystem::path& file) const;  // throws ConfigError
  [[nodiscard]] Subject with_world(const World& world) const {
    return changed([&](Setup& setup) { setup.world = std::make_shared<World>(world); });
  }
  [[nodiscard]] Subject with_templates(const TemplateSet& templates) const {
    return changed([&](Setup& setup) { setup.templates = std::make_shared<TemplateSet>(templates); });
  }
  [[nodiscard]] Subject going_on_from(const OccupancyGrid& grid) const {
    return changed([&](Setup& setup) { setup.grid_so_far = std::make_shared<OccupancyGrid>(grid); });
  }
  [[nodiscard]] Subject starting_at(const Pose2& T_map_start) const {
    return changed([&](Setup& setup) { setup.T_map_start = T_map_start; });
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const Setup& setup() const { return setup_; }

  // Throws what the module's factory throws, and std::runtime_error when it makes nothing.
  [[nodiscard]] std::shared_ptr<Interface> make(std::uint64_t seed = 1) const {
    if (!source_) return checked(factory_(context(nullptr, seed)));
    const auto library = source_->library();
    return checked(library->template make<Interface>(source_->choice(), context(library.get(), seed)));
  }
  // The same from a ModuleLibrary of its own, which is gone before the object is used.
  [[nodiscard]] std::shared_ptr<Interface> make_outliving_library() const {
    if (!source_) return make();
    const auto library = source_->new_library();
    return checked(library->template make<Interface>(source_->choice(), context(library.get(), 1)));
  }

  friend void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.name_; }

 private:
  template <class Change>
  [[nodiscard]] Subject changed(Change change) const {
    Subject copy = *this;
    change(copy.setup_);
    return copy;
  }
  [[nodiscard]] ContextOf<Interface> context(const ModuleLibrary* modules, std::uint64_t seed) const {
    using Context = ContextOf<Interface>;
    const ModuleContext common{setup_.robot, seed, modules};
    if constexpr (std::is_same_v<Context, SensorContext>)
      return {common, setup_.world.get(), setup_.T_map_start};
    else if constexpr (std::is_same_v<Context, LocalizerContext>)
      return {common, setup_.T_map_start, setup_.landmark_shapes, {}, loop_closer_of(modules, common)};
    else if constexpr (std::is_same_v<Context, MapperContext>)
      return {common, setup_.grid_so_far.get()};
    else if constexpr (std::is_same_v<Context, DetectorContext>)
      return {common, setup_.templates};
    else if constexpr (std::is_same_v<Context, BehaviourFactoryContext>)
      return {common};
    else
      return common;
  }
  [[nodiscard]] std::shared_ptr<Interface> checked(std::shared_ptr<Interface> object) const {
    if (object == nullptr) throw std::runtime_error("the factory of " + name_ + " returned null; throw instead");
    return object;
  }

  std::string name_;
  Factory factory_;
  std::shared_ptr<const ModuleSource> source_;  // instead of a factory
  Setup setup_ = default_setup(kind_of<Interface>());
};

[[nodiscard]] RobotModel robot_of_file(const std::filesystem::path& file);

template <class Interface>
Subject<Interface> Subject<Interface>::with_robot_file(const std::filesystem::path& file) const {
  return with_robot(robot_of_file(file));
}

// A module of a folder, by the name it registers; config_yaml as a mission file would have it.
template <class Interface>
[[nodiscard]] Subject<Interface> module(const std::filesystem::path& folder, const std::string& name,
                                        const std::string& config_yaml = "{}") {
  return {name, ModuleSource({folder}, name, config_yaml)};
}

// What every suite is built on.
template <class Interface>
class Conformance : public testing::TestWithParam<Subject<Interface>> {
 protected:
  [[nodiscard]] const Setup& setup() const { return this->GetParam().setup(); }
  [[nodiscard]] std::shared_ptr<Interface> make(std::uint64_t seed = 1) const { return this->GetParam().make(seed); }
};

}  // namespace cairn::conformance
