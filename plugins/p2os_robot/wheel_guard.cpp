#include "plugins/p2os_robot/wheel_guard.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace cairn::p2os_robot {
namespace {

constexpr int kAgainAfter_ms = 50;
constexpr int kBeats = 0;  // descriptors of the guard
constexpr int kPort = 1;
constexpr std::size_t kMaxStop = 64;

struct Stop {
  std::array<std::uint8_t, kMaxStop> bytes{};
  std::size_t size = 0;
};

// In the new process, which has one thread only and may do what a signal handler may.
[[noreturn]] void watch(int beats, int port, const Stop& stop, int silence_ms) {
  ::setsid();  // neither Ctrl-C nor Ctrl-Z reaches it
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT}) ::signal(signal, SIG_IGN);
  ::prctl(PR_SET_NAME, "cairn-wheels");
  const int copy = ::fcntl(port, F_DUPFD, 3);
  ::dup2(beats, kBeats);
  ::dup2(copy, kPort);
  ::close_range(2, ~0U, 0);
  int wait_ms = silence_ms;
  for (;;) {
    pollfd ready{kBeats, POLLIN, 0};
    if (::poll(&ready, 1, wait_ms) > 0) {
      char heard[64];
      if (::read(kBeats, heard, sizeof heard) <= 0) break;
      wait_ms = silence_ms;
      continue;
    }
    (void)!::write(kPort, stop.bytes.data(), stop.size);
    wait_ms = kAgainAfter_ms;
  }
  (void)!::write(kPort, stop.bytes.data(), stop.size);
  ::_exit(0);
}

}  // namespace

WheelGuard::WheelGuard(int port, std::span<const std::uint8_t> stop, std::chrono::milliseconds silence) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) != 0)
    throw std::runtime_error(std::strerror(errno));
  const Descriptor reading(ends[0]);
  beats_ = Descriptor(ends[1]);
  Stop bytes;
  bytes.size = std::min(stop.size(), kMaxStop);
  std::copy_n(stop.begin(), bytes.size, bytes.bytes.begin());
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error(std::string("no process to watch the wheels: ") + std::strerror(errno));
  if (process_ == 0) {
    ::close(ends[1]);
    watch(ends[0], port, bytes, static_cast<int>(silence.count()));
  }
}

WheelGuard::~WheelGuard() {
  beats_ = Descriptor();
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void WheelGuard::beat() noexcept {
  const char one = 1;
  if (::send(beats_.get(), &one, 1, MSG_NOSIGNAL) < 0 && errno == EPIPE) is_there_ = false;
}

}  // namespace cairn::p2os_robot
