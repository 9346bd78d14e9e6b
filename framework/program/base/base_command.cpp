#include <iostream>

#include "framework/live/line_socket.hpp"
#include "framework/live/served_robot.hpp"
#include "framework/mission/modules.hpp"
#include "framework/program/base/base_server.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/common/making_watch.hpp"
#include "framework/program/common/modules.hpp"

namespace cairn {

int base(const BaseCommand& command, const CommonOptions& common) {
  const std::atomic<bool>& end = cancel_on_interrupt();
  const live::Address address = live::address_of(command.listen);
  const Mission mission = load_mission(command.mission, command.overrides, command.seed);
  const ModuleLibrary library = module_library(common);
  const MakingWatch watch = watch_making(max_making_s(mission.config.watchdog_s), end);
  live::ServedRobot robot(build_sensor(mission, library), mission.robot);
  BaseServer server(robot, address, {command.pace, command.log});
  std::cout << "base of mission " << mission.config.mission << " listens at " << live::text_of(address) << "\n"
            << std::flush;
  server.run(end);
  return kExitDone;
}

}  // namespace cairn
