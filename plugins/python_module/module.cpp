#include "framework/contracts/module.hpp"

#include "plugins/python_module/python_behaviour.hpp"
#include "plugins/python_module/python_detector.hpp"
#include "plugins/python_module/python_sensor.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using namespace cairn::python_module;
  registrar.add<cairn::Sensor, Config>("python", "a sensor written in Python",
                                       [](const Config& config, const cairn::SensorContext& context) {
                                         return std::make_unique<PythonSensor>(config, context);
                                       });
  registrar.add<cairn::Detector, Config>("python", "a detector written in Python",
                                         [](const Config& config, const cairn::DetectorContext& context) {
                                           return std::make_unique<PythonDetector>(config, context);
                                         });
  registrar.add<cairn::Behaviour, BehaviourConfig>(
      "python", "a step written in Python",
      [](const BehaviourConfig& config, const cairn::BehaviourFactoryContext& context) {
        return std::make_unique<PythonBehaviour>(config, context);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
