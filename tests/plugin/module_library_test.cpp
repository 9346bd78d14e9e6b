#include "framework/modules/module_library.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

extern "C" void cairn_register_odometry_compass(cairn::Registrar& registrar);

namespace cairn {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

fs::path folder_of(const std::string& fault) {
  return fs::path(CAIRN_BINARY_DIR) / "tests" / "plugin" / fault;
}

PluginChoice choice_of(const std::string& name) {
  PluginChoice choice{name, {}};
  choice.config.kind = ConfigValue::Kind::map;
  choice.config.place = {"mission.yaml", 7, 3};
  return choice;
}

std::string error_of(const ModuleLibrary& library, const std::string& name) {
  try {
    (void)library.find(PluginKind::localizer, name, {"mission.yaml", 7, 3});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ModuleLibrary, SaysThatALibraryIsNoModule) {
  const ModuleLibrary library({folder_of("not_a_module")});
  EXPECT_THAT(library.entries(), IsEmpty());
  EXPECT_THAT(library.faults(), ElementsAre(AllOf(HasSubstr("not_a_module.so: is not a Cairn module"),
                                                  HasSubstr("it exports no cairn_abi_stamp"))));
}

TEST(ModuleLibrary, NamesBothSidesOfAWrongAbiStamp) {
  const ModuleLibrary library({folder_of("wrong_stamp")});
  EXPECT_THAT(library.faults(), ElementsAre(AllOf(HasSubstr("wrong_stamp.so: was built with another ABI"),
                                                  HasSubstr("module:  cairn 0.1.0, gcc 99.0"),
                                                  HasSubstr("program: " + text_of(this_abi_stamp())))));
}

TEST(ModuleLibrary, SaysWhatAModuleThrewWhileRegistering) {
  const ModuleLibrary library({folder_of("throws_at_load")});
  EXPECT_THAT(library.faults(), ElementsAre(HasSubstr("throws_at_load.so: threw while registering: no licence found")));
}

TEST(ModuleLibrary, SaysThatATextFileCannotBeOpened) {
  const fs::path folder = fs::path(testing::TempDir()) / "cairn_text_plugin";
  fs::create_directories(folder);
  std::ofstream(folder / "text.so") << std::string(4096, '#');
  const ModuleLibrary library({folder});
  EXPECT_THAT(library.faults(),
              ElementsAre(AllOf(HasSubstr("text.so: cannot be opened as a module"), HasSubstr("ELF"))));
}

TEST(ModuleLibrary, SaysWhichLibraryAModuleMisses) {
  const ModuleLibrary library({folder_of("needs_missing_library")});
  EXPECT_THAT(library.faults(), ElementsAre(AllOf(HasSubstr("needs_missing_library.so: cannot be opened as a module"),
                                                  HasSubstr("libcairn_test_missing.so"))));
}

TEST(ModuleLibrary, TakesModulesThatAreLinkedIn) {
  Registrar registrar;
  cairn_register_odometry_compass(registrar);
  ModuleLibrary library({});
  library.add("(linked in)", registrar);
  const RobotModel robot;
  EXPECT_NE(library.make<Localizer>(choice_of("odometry_compass"), {{robot}}), nullptr);
  EXPECT_EQ(library.find_any("odometry_compass")->plugin->file, "(linked in)");
}

// Of two kinds with one name, as one library may register them.
template <class Interface>
void add_nothing(Registrar& registrar, const std::string& summary) {
  registrar.add<Interface, NoConfig>(
      "twin", summary, [](const NoConfig&, const ContextOf<Interface>&) { return std::unique_ptr<Interface>(); });
}

TEST(ModuleLibrary, ANameIsThatOfOneModuleAKind) {
  Registrar registrar;
  add_nothing<Sensor>(registrar, "a sensor");
  add_nothing<Localizer>(registrar, "a localizer");
  add_nothing<PathPlanner>(registrar, "a path planner");
  add_nothing<Planner>(registrar, "a planner, which a path planner serves as");
  add_nothing<Sensor>(registrar, "another sensor");
  ModuleLibrary library({});
  library.add("(linked in)", registrar);
  EXPECT_EQ(library.find(PluginKind::sensor, "twin", {}).summary, "a sensor");
  EXPECT_EQ(library.find(PluginKind::localizer, "twin", {}).summary, "a localizer");
  EXPECT_EQ(library.find(PluginKind::planner, "twin", {}).summary, "a path planner");
  EXPECT_EQ(library.find_of(PluginKind::detector, "twin"), nullptr);
  EXPECT_THROW((void)library.find(PluginKind::detector, "twin", {}), ConfigError);
  EXPECT_EQ(library.entries().size(), 3U);
  EXPECT_EQ(library.faults().size(), 2U) << "the planner and the second sensor";
}

TEST(ModuleLibrary, AMissingFolderIsAFault) {
  const ModuleLibrary library({"/nowhere/at/all"});
  EXPECT_THAT(library.faults(), ElementsAre("/nowhere/at/all: no such plugin folder"));
}

TEST(ModuleLibrary, AnUnknownNameIsAnErrorWithPlaceAndNearestName) {
  const ModuleLibrary library({folder_of("faulty")});
  EXPECT_EQ(error_of(library, "stil_localizer"),
            "mission.yaml:7:3: unknown localizer plugin \"stil_localizer\" (did you mean \"still_localizer\"?); known "
            "are: asking_localizer, crashing_constructor, exiting_constructor, hanging_constructor, nan_localizer, "
            "still_localizer, throwing_constructor");
}

// A name is looked up, never opened: a mission that comes from elsewhere brings no code along.
TEST(ModuleLibrary, ANameIsNoPath) {
  const ModuleLibrary library({folder_of("needs_missing_library")});
  const fs::path file = folder_of("faulty") / "faulty.so";
  ASSERT_TRUE(fs::exists(file));
  const std::string up_and_down = "../faulty/faulty.so";
  const std::vector<std::string> names{file.string(),     file.string() + std::string("\0.so", 4),
                                       up_and_down,       "../faulty/faulty",
                                       "still_localizer", std::string("..")};
  for (const std::string& name : names)
    EXPECT_THAT(error_of(library, name), HasSubstr("unknown localizer plugin")) << name;
  EXPECT_THAT(error_of(ModuleLibrary({folder_of("faulty")}), std::string("still_localizer\0", 16)),
              HasSubstr("unknown localizer plugin"));
}

TEST(ModuleLibrary, ANameOfAnotherKindIsAnError) {
  const ModuleLibrary library({folder_of("faulty")});
  EXPECT_EQ(error_of(library, "empty_map"), "mission.yaml:7:3: \"empty_map\" is a map plugin, not a localizer");
}

TEST(ModuleLibrary, TheFirstOfTwoModulesKeepsTheName) {
  const ModuleLibrary library({folder_of("faulty"), folder_of("faulty")});
  EXPECT_FALSE(library.faults().empty());
  EXPECT_THAT(library.faults().front(), HasSubstr("the name \"counting_sensor\" is taken by"));
}

TEST(ModuleLibrary, AnObjectOutlivesTheLibraryThatLoadedIt) {
  std::shared_ptr<Localizer> localizer;
  {
    const ModuleLibrary library({folder_of("faulty")});
    const RobotModel robot;
    localizer = library.make<Localizer>(choice_of("still_localizer"), {{robot}});
  }
  const OccupancyGrid grid(0.05);
  const LandmarkGraph landmarks;
  EXPECT_EQ(localizer->update({}, {grid, landmarks}).T_map_robot, Pose2{});
}

// The module and the host have type information of their own, which is compared by name.
TEST(ModuleLibrary, AnErrorThatAModuleThrowsIsCaughtByItsType) {
  const ModuleLibrary library({folder_of("faulty")});
  const RobotModel robot;
  try {
    (void)library.make<Sensor>(choice_of("refusing_sensor"), {{robot}});
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.place().line, 3);
    EXPECT_THAT(error.what(), HasSubstr("there is no such port"));
  }
}

TEST(ModuleLibrary, AnObjectOfAModuleIsCastToTheInterfacesThatItHas) {
  const ModuleLibrary library({folder_of("faulty")});
  const RobotModel robot;
  const auto sensor = library.make<Sensor>(choice_of("counting_sensor"), {{robot}});
  ASSERT_NE(sensor->drive(), nullptr);
  EXPECT_EQ(dynamic_cast<Drive*>(sensor.get()), sensor->drive());
  EXPECT_EQ(dynamic_cast<Localizer*>(sensor.get()), nullptr);
}

TEST(ModuleLibrary, UnknownConfigKeysAreRefused) {
  const ModuleLibrary library({folder_of("faulty")});
  const RobotModel robot;
  PluginChoice choice = choice_of("counting_sensor");
  ConfigValue value;
  value.kind = ConfigValue::Kind::scalar;
  value.scalar = "3";
  value.place = {"mission.yaml", 8, 15};
  ConfigValue::Entry& entry = choice.config.entries.emplace_back();
  entry.key = "reading";
  entry.key_place = {"mission.yaml", 8, 5};
  entry.value = value;
  try {
    (void)library.make<Sensor>(choice, {{robot}});
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("mission.yaml:8:5"), HasSubstr("reading"), HasSubstr("readings")));
  }
}

}  // namespace
}  // namespace cairn
