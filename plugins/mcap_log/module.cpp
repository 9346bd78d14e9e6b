#include "framework/contracts/module.hpp"

#include "plugins/mcap_log/mcap_log.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace mcap_log = cairn::mcap_log;
  registrar.add<cairn::Sensor, mcap_log::Config>(
      "mcap_log", "plays back an MCAP file of ROS 2 (rosbag2): laser and sonar ranges with odometry",
      [](const mcap_log::Config& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::log_common::ScanPlayer>(mcap_log::read_mcap_log(config, context.budget));
      });
}

}  // namespace

CAIRN_MODULE(register_module)
