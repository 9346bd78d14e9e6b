#include "framework/contracts/module.hpp"

#include "plugins/laser_log/laser_log.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace laser_log = cairn::laser_log;
  registrar.add<cairn::Sensor, laser_log::Config>(
      "laser_log", "plays back laser scans with odometry from a log of any kind that its content shows",
      [](const laser_log::Config& config, const cairn::SensorContext& context) {
        if (context.modules == nullptr) throw std::invalid_argument("laser_log: no maker of modules in its context");
        const cairn::PluginChoice reader = laser_log::reader_of(config.file, context.budget);
        const double longest_m = laser_log::longest_echo_m(*context.modules->make<cairn::Sensor>(reader, context),
                                                           config.longest_m, context.budget);
        return std::make_unique<laser_log::LaserLog>(context.modules->make<cairn::Sensor>(reader, context), longest_m,
                                                     config);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
