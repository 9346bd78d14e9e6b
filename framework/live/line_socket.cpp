#include "framework/live/line_socket.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "framework/live/wire.hpp"

namespace cairn::live {
namespace {

constexpr int kConnectWithin_ms = 200;
constexpr int kBacklog = 64;

union Name {
  sockaddr any;
  sockaddr_un local;
  sockaddr_in internet;
};

[[noreturn]] void fail(const Address& address, const std::string& what) {
  throw std::runtime_error(text_of(address) + ": " + what);
}

socklen_t name_of(const Address& address, Name& name) {
  name = {};
  if (!address.socket.empty()) {
    if (address.socket.size() >= sizeof name.local.sun_path)
      fail(address, "the path of a socket has at most " + std::to_string(sizeof name.local.sun_path - 1) + " bytes");
    name.local.sun_family = AF_UNIX;
    address.socket.copy(name.local.sun_path, sizeof name.local.sun_path - 1);
    return sizeof name.local;
  }
  name.internet.sin_family = AF_INET;
  name.internet.sin_port = htons(static_cast<std::uint16_t>(address.port));
  const std::string host = address.host == "localhost" ? "127.0.0.1" : address.host;
  if (::inet_pton(AF_INET, host.c_str(), &name.internet.sin_addr) != 1)
    fail(address, "the host must be localhost or an IPv4 address");
  return sizeof name.internet;
}

Descriptor new_socket(const Address& address) {
  const int family = address.socket.empty() ? AF_INET : AF_UNIX;
  Descriptor made(::socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (made.get() < 0) fail(address, std::strerror(errno));
  const int on = 1;
  if (family == AF_INET) ::setsockopt(made.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return made;
}

// One whose owner was killed: nobody listens there.
void remove_stale_socket(const Address& address) {
  std::error_code none;
  if (!std::filesystem::is_socket(address.socket, none)) return;
  std::string error;
  if (connect_to(address, error).get() >= 0) fail(address, "another process listens there");
  std::filesystem::remove(address.socket, none);
}

}  // namespace

Address address_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || text.find('/') != std::string::npos) {
    if (text.empty()) throw std::runtime_error("an address is a path or HOST:PORT");
    return {text, {}, 0};
  }
  Address address{{}, text.substr(0, colon), 0};
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data() + colon + 1, end, address.port);
  if (error != std::errc() || at != end || address.port < 1 || address.port > 65535)
    throw std::runtime_error(text + ": a port is a number from 1 to 65535");
  return address;
}

std::string text_of(const Address& address) {
  return address.socket.empty() ? address.host + ":" + std::to_string(address.port) : address.socket;
}

Descriptor listen_at(const Address& address) {
  Name name;
  socklen_t size = name_of(address, name);
  Descriptor made = new_socket(address);
  const int on = 1;
  if (address.socket.empty()) {
    if (ntohl(name.internet.sin_addr.s_addr) >> 24U != 127U) fail(address, "it listens on this computer only");
    ::setsockopt(made.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  } else {
    remove_stale_socket(address);
    // Before it is bound, so that nobody else may connect at any time.
    if (::fchmod(made.get(), S_IRUSR | S_IWUSR) != 0) fail(address, std::strerror(errno));
  }
  if (::bind(made.get(), &name.any, size) != 0 || ::listen(made.get(), kBacklog) != 0)
    fail(address, std::strerror(errno));
  return made;
}

Descriptor connect_to(const Address& address, std::string& error) {
  Name name;
  const socklen_t size = name_of(address, name);
  Descriptor made = new_socket(address);
  if (::connect(made.get(), &name.any, size) == 0) return made;
  int reason = errno;
  if (reason == EINPROGRESS) {
    pollfd ready{made.get(), POLLOUT, 0};
    socklen_t length = sizeof reason;
    if (::poll(&ready, 1, kConnectWithin_ms) != 1)
      reason = ETIMEDOUT;
    else
      ::getsockopt(made.get(), SOL_SOCKET, SO_ERROR, &reason, &length);
    if (reason == 0) return made;
  }
  error = std::strerror(reason);
  return Descriptor();
}

bool LineReader::read(int socket) {
  std::array<char, 16384> buffer;
  while (true) {
    const ssize_t got = ::recv(socket, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return errno == EAGAIN || errno == EWOULDBLOCK;
    if (got == 0) return false;
    text_.append(buffer.data(), static_cast<std::size_t>(got));
    if (text_.find('\n', begin_) == std::string::npos && text_.size() - begin_ > kMaxLineBytes) return false;
    if (text_.size() - begin_ > 4 * kMaxLineBytes) return true;  // the rest another time
  }
}

std::optional<std::string> LineReader::next() {
  for (std::size_t end = 0; (end = text_.find('\n', begin_)) != std::string::npos;) {
    std::string line = text_.substr(begin_, end - begin_);
    begin_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty()) return line;
  }
  text_.erase(0, begin_);
  begin_ = 0;
  return std::nullopt;
}

void LineReader::clear() {
  text_.clear();
  begin_ = 0;
}

bool LineWriter::write(int socket, std::string_view line) {
  const auto send = [&](std::string_view text) -> ssize_t {
    const ssize_t sent = ::send(socket, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent >= 0) return sent;
    return errno == EAGAIN || errno == EINTR || errno == EWOULDBLOCK ? 0 : -1;
  };
  if (!waiting_.empty()) {
    const ssize_t sent = send(waiting_);
    if (sent < 0) return false;
    waiting_.erase(0, static_cast<std::size_t>(sent));
    if (!waiting_.empty()) return true;
  }
  std::string text(line);
  text += '\n';
  const ssize_t sent = send(text);
  if (sent < 0) return false;
  if (sent > 0) waiting_ = text.substr(static_cast<std::size_t>(sent));
  return true;
}

bool send_now(int socket, std::string_view text) noexcept {
  return ::send(socket, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
}

}  // namespace cairn::live
