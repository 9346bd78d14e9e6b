#include "framework/contracts/module.hpp"

#include "plugins/sonar_from_laser/sonar_from_laser.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace sonar_from_laser = cairn::sonar_from_laser;
  registrar.add<cairn::Sensor, sonar_from_laser::Config>(
      "sonar_from_laser", "sonar readings derived from another sensor's laser scans: the nearest echo in each cone",
      [](const sonar_from_laser::Config& config, const cairn::SensorContext& context) {
        if (context.modules == nullptr)
          throw std::invalid_argument("sonar_from_laser: no maker of modules in its context");
        return std::make_unique<sonar_from_laser::SonarFromLaser>(
            context.modules->make<cairn::Sensor>(config.source, context), context.robot.sonars);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
