#include "framework/program/view/run_stream.hpp"

#include <unistd.h>

#include <exception>

#include "framework/program/mission/control_socket.hpp"

namespace cairn {

RunStream watch_run(const std::filesystem::path& folder) {
  if (folder.empty()) return {-1, "this is the view of a map"};
  try {
    const MissionConnection run = connect_to_mission(folder);
    if (run.reached != Reached::answered || !write_line(run.socket.get(), "watch"))
      return {-1, "no mission runs there"};
    const int own = ::dup(run.socket.get());
    if (own < 0) return {-1, "so many files are open already that none is left for another stream"};
    return {own, ""};
  } catch (const std::exception& error) {
    return {-1, error.what()};
  }
}

}  // namespace cairn
