// The robot and the world of a mission in Enki, with a Pioneer's microcontroller on a pseudo-terminal, in wall-clock
// time:
//     enki_pioneer MISSION LINK LOG [KEY=VALUE...]
// LINK becomes a link to the terminal; LOG: tests/enki/enki_world.hpp; KEY=VALUE: as with `cairn run --set`.
#include <atomic>
#include <csignal>
#include <filesystem>
#include <iostream>

#include "tests/enki/enki_world.hpp"
#include "tests/plugins/p2os_robot/pioneer_on_a_terminal.hpp"

namespace {

std::atomic<bool> is_ended{false};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "enki_pioneer MISSION LINK LOG [KEY=VALUE...]\n";
    return 2;
  }
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { is_ended = true; });
  try {
    const cairn::Mission mission = cairn::load_mission(argv[1], {argv + 4, argv + argc});
    const std::filesystem::path link = argv[2];
    cairn::p2os_robot::PioneerOnATerminal pioneer("p3dx-sh", cairn::enki::robot_in_its_world(mission, argv[3]));
    pioneer.say_every_s = 0.1;
    std::filesystem::remove(link);
    std::filesystem::create_symlink(pioneer.device(), link);
    std::cout << "a Pioneer 3-DX at " << link.string() << "\n" << std::flush;
    while (!is_ended) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::filesystem::remove(link);
  } catch (const std::exception& fault) {
    std::cerr << "enki_pioneer: " << fault.what() << "\n";
    return 1;
  }
  return 0;
}
