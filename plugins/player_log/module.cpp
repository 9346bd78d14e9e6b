#include "framework/contracts/module.hpp"

#include "plugins/player_log/player_log.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace player_log = cairn::player_log;
  registrar.add<cairn::Sensor, player_log::Config>(
      "player_log", "plays back a Player log: sonar and laser ranges with odometry",
      [](const player_log::Config& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::log_common::ScanPlayer>(
            player_log::read_player_log(config, context.robot, context.budget));
      });
}

}  // namespace

CAIRN_MODULE(register_module)
