// The socket in an output folder by which the mission that runs there is controlled.
//
// A Unix-domain socket: no network, and the kernel says who is at the other end and whether anyone still is. One line
// goes in (pause, resume, cancel, status, or order with JSON behind it), one line of JSON comes out, and the connection
// ends. After `watch` it stays, and lines come until the run ends.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "framework/live/descriptor.hpp"

namespace cairn {

inline constexpr const char* kControlSocket = "control.sock";
inline constexpr std::size_t kMaxCommandBytes = 1024;

// Listens there without waiting in accept(); only the user may connect. Takes a socket away that an earlier run has
// left: hold the folder first. Throws std::runtime_error with the reason.
[[nodiscard]] Descriptor listen_in(const std::filesystem::path& folder);
void remove_socket(const std::filesystem::path& folder);

// Up to the first line end, or the end of what comes; nothing when it is longer than that, or slower.
[[nodiscard]] std::optional<std::string> read_line(int socket, std::size_t max_bytes,
                                                   std::chrono::milliseconds at_most);
// False when the other end has gone.
bool write_line(int socket, std::string line);

enum class Reached { answered, nobody, left_behind };
struct ControlAnswer {
  Reached reached = Reached::nobody;  // left_behind: a run that was killed has left its socket
  std::string line{};
};
struct MissionConnection {
  Reached reached = Reached::nobody;  // answered: somebody listens
  Descriptor socket{};
};
// Throws std::runtime_error when the mission that runs there may not be asked.
[[nodiscard]] MissionConnection connect_to_mission(const std::filesystem::path& folder);
// Asks the mission that runs there. Throws std::runtime_error when it may not be asked or does not answer.
[[nodiscard]] ControlAnswer ask_mission(const std::filesystem::path& folder, const std::string& command);

}  // namespace cairn
