#include "framework/contracts/module.hpp"

#include "text_board.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  registrar.add<cairn::Sensor, text_board::Config>(
      "text_board", "drives a base whose board talks in lines of text",
      [](const text_board::Config& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::live::LiveRobot>(std::make_unique<text_board::TextBoard>(config, context.robot),
                                                        config.stop_when, context.robot);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
