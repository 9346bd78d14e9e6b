#include "tests/plugins/python_module/python_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "framework/modules/module_library.hpp"

namespace cairn::testing_python {
namespace {

const ModuleLibrary& library() {
  static const ModuleLibrary modules({std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn"});
  return modules;
}

RobotModel three_sonars() {
  RobotModel robot;
  for (const double angle_deg : {90.0, 0.0, -90.0}) {
    SonarModel sonar;
    sonar.T_robot_sonar = {0.0, 0.0, radians(angle_deg)};
    robot.sonars.push_back(sonar);
  }
  return robot;
}

std::string config_of(const std::string& text, const std::string& settings) {
  return "file: " + python_file(text).string() + "\nclass: It\n" +
         (settings.empty() ? "" : "settings: " + settings + "\n");
}

template <class Interface>
std::shared_ptr<Interface> made_with(const std::string& config) {
  const RobotModel robot = three_sonars();
  return library().make<Interface>({"python", parse_config_text(config, "mission.yaml")},
                                   ContextOf<Interface>{{robot, 7}});
}

}  // namespace

std::filesystem::path python_file(const std::string& text) {
  static int count = 0;
  const auto folder = std::filesystem::path(testing::TempDir()) / ("cairn_python_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto file = folder / ("it_" + std::to_string(++count) + ".py");
  std::ofstream(file) << text;
  return file;
}

std::shared_ptr<Detector> detector_of(const std::string& text, const std::string& settings) {
  return made_with<Detector>(config_of(text, settings));
}
std::shared_ptr<Behaviour> behaviour_of(const std::string& text, const std::string& settings) {
  return made_with<Behaviour>(config_of(text, settings));
}
std::shared_ptr<Sensor> sensor_of(const std::string& text, const std::string& settings) {
  return made_with<Sensor>(config_of(text, settings));
}
std::shared_ptr<Detector> detector_with(const std::string& config) {
  return made_with<Detector>(config);
}

}  // namespace cairn::testing_python
