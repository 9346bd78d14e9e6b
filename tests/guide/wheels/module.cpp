#include "framework/contracts/module.hpp"

#include <fcntl.h>

#include <cerrno>
#include <cstring>

#include "board_robot.hpp"

namespace {

// Here, not while the module registers: the line is opened when a mission needs it.
std::unique_ptr<cairn::Sensor> board_robot(const wheels::Config& config, const cairn::SensorContext& context) {
  const int line = ::open(config.device.c_str(), O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (line < 0) throw std::runtime_error(config.device + " cannot be opened: " + std::strerror(errno));
  return std::make_unique<wheels::BoardRobot>(line, config, context.robot);
}

void register_module(cairn::Registrar& registrar) {
  registrar.add<cairn::Sensor, wheels::Config>("board_robot", "a robot behind a motor board", board_robot);
}

}  // namespace

CAIRN_MODULE(register_module)
