#include "framework/live/guard_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>

namespace cairn::live {
namespace {

constexpr int kAgainAfter_ms = 50;
constexpr int kLastTimes = 5;
constexpr int kEndedWithin_ms = 10;  // a process that has been killed

}  // namespace

GuardProcess::GuardProcess(const std::function<void(int beats)>& watch) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) != 0)
    throw std::runtime_error(std::strerror(errno));
  const Descriptor reading(ends[0]);
  beats_ = Descriptor(ends[1]);
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error(std::string("no process to watch the wheels: ") + std::strerror(errno));
  if (process_ > 0) return;
  ::setsid();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT}) ::signal(signal, SIG_IGN);
  ::prctl(PR_SET_NAME, "cairn-wheels");
  ::close(ends[1]);
  watch(ends[0]);
  ::_exit(0);
}

GuardProcess::~GuardProcess() {
  beats_ = Descriptor();
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void GuardProcess::beat(double note) noexcept {
  if (::send(beats_.get(), &note, sizeof note, MSG_NOSIGNAL) < 0 && errno == EPIPE) is_there_ = false;
}

void write_in_silence(int beats, int line, const std::vector<std::uint8_t>& bytes, std::chrono::milliseconds silence) {
  constexpr int kBeats = 0;
  constexpr int kLine = 1;
  const pid_t parent = ::getppid();
  const int copy = ::fcntl(line, F_DUPFD, kLine + 1);
  ::dup2(beats, kBeats);
  ::dup2(copy, kLine);
  ::close_range(kLine + 1, ~0U, 0);
  const auto write_bytes = [&](double) { (void)!::write(kLine, bytes.data(), bytes.size()); };
  watch_beats(kBeats, silence, write_bytes);
  write_bytes(0.0);
  ::poll(nullptr, 0, kEndedWithin_ms);
  for (int i = 0; i < kLastTimes && ::getppid() != parent; ++i, ::poll(nullptr, 0, kAgainAfter_ms)) write_bytes(0.0);
}

void watch_beats(int beats, std::chrono::milliseconds silence, const std::function<void(double note)>& stop) {
  double note = 0.0;
  int wait_ms = static_cast<int>(silence.count());
  for (;;) {
    pollfd ready{beats, POLLIN, 0};
    if (::poll(&ready, 1, wait_ms) > 0) {
      if (::recv(beats, &note, sizeof note, 0) <= 0) return;
      wait_ms = static_cast<int>(silence.count());
      continue;
    }
    stop(note);
    wait_ms = kAgainAfter_ms;
  }
}

}  // namespace cairn::live
