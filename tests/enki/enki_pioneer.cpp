// A Pioneer 3-DX in a world of Enki, with its microcontroller on a pseudo-terminal, in wall-clock time:
//     enki_pioneer LINK LOG
// LINK becomes a link to the terminal; LOG: tests/enki/enki_world.hpp.
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
  if (argc != 3) {
    std::cerr << "enki_pioneer LINK LOG\n";
    return 2;
  }
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { is_ended = true; });
  cairn::p2os_robot::PioneerOnATerminal pioneer("p3dx-sh", cairn::enki::pioneer_in_two_rooms(argv[2]));
  pioneer.say_every_s = 0.1;
  std::filesystem::remove(argv[1]);
  std::filesystem::create_symlink(pioneer.device(), argv[1]);
  std::cout << "a Pioneer 3-DX at " << argv[1] << "\n" << std::flush;
  while (!is_ended) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::filesystem::remove(argv[1]);
  return 0;
}
