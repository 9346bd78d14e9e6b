#include "framework/contracts/module.hpp"

#include "plugins/mcap_log/mcap_log.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace mcap_log = cairn::mcap_log;
  registrar.add<cairn::Sensor, mcap_log::Config>(
      "mcap_log", "plays back an MCAP file of ROS 2 (rosbag2): laser and sonar ranges with odometry",
      [](const mcap_log::Config& config, const cairn::SensorContext& context) -> std::unique_ptr<cairn::Sensor> {
        using cairn::log_common::ScanPlayer;
        if (!context.wants_images) return std::make_unique<ScanPlayer>(mcap_log::read_mcap_log(config, context.budget));
        mcap_log::LogWithPictures log = mcap_log::read_with_pictures(config, context.robot.cameras, context.budget);
        return std::make_unique<cairn::pictures::PicturePlayer>(std::make_shared<ScanPlayer>(std::move(log.scans)),
                                                                log.pictures);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
