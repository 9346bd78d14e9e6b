#include "framework/program/mission/control_socket.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace cairn {
namespace {

constexpr std::chrono::seconds kAnswerWithin(90);  // longer than a mission takes to stop
constexpr std::size_t kMaxAnswerBytes = 1U << 20U;
constexpr int kBacklog = 512;  // that wait to be let in

std::string text_of_error(int error) {
  return std::strerror(error);
}

[[noreturn]] void fail(const std::filesystem::path& folder, const std::string& what) {
  throw std::runtime_error((folder / kControlSocket).string() + ": " + what);
}

// A socket's name holds 107 characters, a folder's any number: by way of the opened folder it is short.
struct Address {
  Descriptor folder;
  sockaddr_un name{};
};

Address address_in(const std::filesystem::path& folder) {
  Address address{Descriptor(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC))};
  if (address.folder.get() < 0) fail(folder, "the folder cannot be opened: " + text_of_error(errno));
  const std::string path = fmt::format("/proc/self/fd/{}/{}", address.folder.get(), kControlSocket);
  address.name.sun_family = AF_UNIX;
  path.copy(address.name.sun_path, sizeof address.name.sun_path - 1);
  return address;
}

const sockaddr* base_of(const Address& address) {
  return reinterpret_cast<const sockaddr*>(&address.name);  // NOLINT: as the C interface wants it
}

// A socket that an earlier run has left, or a link, wherever it leads. Anything else is not ours.
void remove_what_stands_there(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::file_status found = std::filesystem::symlink_status(folder / kControlSocket, error);
  if (!std::filesystem::exists(found)) return;
  if (!std::filesystem::is_socket(found) && !std::filesystem::is_symlink(found))
    fail(folder, "is no socket; remove it");
  remove_socket(folder);
}

Descriptor new_socket(const std::filesystem::path& folder, int flags = 0) {
  Descriptor made(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | flags, 0));
  if (made.get() < 0) fail(folder, "no socket can be made: " + text_of_error(errno));
  return made;
}

}  // namespace

Descriptor listen_in(const std::filesystem::path& folder) {
  remove_what_stands_there(folder);
  const Address address = address_in(folder);
  Descriptor made = new_socket(folder, SOCK_NONBLOCK);
  // Before it is bound, so that nobody else may connect at any time.
  if (::fchmod(made.get(), S_IRUSR | S_IWUSR) != 0 || ::bind(made.get(), base_of(address), sizeof address.name) != 0 ||
      ::listen(made.get(), kBacklog) != 0)
    fail(folder, text_of_error(errno));
  return made;
}

void remove_socket(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::remove(folder / kControlSocket, error);
}

std::optional<std::string> read_line(int socket, std::size_t max_bytes, std::chrono::milliseconds at_most) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point until = Clock::now() + at_most;
  std::string text;
  while (text.size() <= max_bytes) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
    pollfd ready{socket, POLLIN, 0};
    const int count = left.count() <= 0 ? 0 : ::poll(&ready, 1, static_cast<int>(left.count()));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    char buffer[4096];
    const ssize_t got = ::recv(socket, buffer, sizeof buffer, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) return text;
    text.append(buffer, static_cast<std::size_t>(got));
    if (const std::size_t end = text.find('\n'); end != std::string::npos && end <= max_bytes) {
      text.resize(end);
      return text;
    }
  }
  return std::nullopt;
}

bool write_line(int socket, std::string line) {
  line += '\n';
  for (std::size_t sent = 0; sent < line.size();) {
    const ssize_t count = ::send(socket, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

MissionConnection connect_to_mission(const std::filesystem::path& folder) {
  const Address address = address_in(folder);
  Descriptor made = new_socket(folder);
  const timeval at_most{kAnswerWithin.count(), 0};  // for the connection, too: the process may have been stopped
  ::setsockopt(made.get(), SOL_SOCKET, SO_SNDTIMEO, &at_most, sizeof at_most);
  if (::connect(made.get(), base_of(address), sizeof address.name) != 0) {
    if (errno == ENOENT) return {Reached::nobody};
    if (errno == ECONNREFUSED) return {Reached::left_behind};
    fail(folder, errno == EACCES ? "only the user who runs the mission may control it" : text_of_error(errno));
  }
  return {Reached::answered, std::move(made)};
}

ControlAnswer ask_mission(const std::filesystem::path& folder, const std::string& command) {
  const MissionConnection connection = connect_to_mission(folder);
  if (connection.reached != Reached::answered) return {connection.reached};
  std::optional<std::string> line;
  if (write_line(connection.socket.get(), command))
    line = read_line(connection.socket.get(), kMaxAnswerBytes, kAnswerWithin);
  if (!line || line->empty()) fail(folder, "the mission does not answer");
  return {Reached::answered, *line};
}

}  // namespace cairn
