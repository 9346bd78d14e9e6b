// Connections of a base with its client, or of a server of plans with those who ask: a Unix-domain socket that only the
// user may connect to, or TCP. Lines come and go without waiting.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "framework/live/descriptor.hpp"

namespace cairn::live {

struct Address {
  std::string socket;  // path; empty: TCP
  std::string host;    // localhost or an IPv4 address
  int port = 0;
};
// "HOST:PORT" or a path. Throws std::runtime_error.
[[nodiscard]] Address address_of(const std::string& text);
[[nodiscard]] std::string text_of(const Address& address);

// Does not wait in accept(). TCP: for this computer only. Takes a socket away that an earlier base has left. Throws
// std::runtime_error with the reason.
[[nodiscard]] Descriptor listen_at(const Address& address);
// No descriptor: nobody is there; error says why. Does not wait longer than 0.2 s.
[[nodiscard]] Descriptor connect_to(const Address& address, std::string& error);

// Lines as they come, empty ones left out.
class LineReader {
 public:
  // Reads what is there. False when the other end has gone, or sends a line beyond all limits.
  [[nodiscard]] bool read(int socket);
  [[nodiscard]] std::optional<std::string> next();
  void clear();

 private:
  std::string text_;
  std::size_t begin_ = 0;
};

// Whole lines to somebody who may be slow: what finds no room is left out.
class LineWriter {
 public:
  // False when the other end has gone.
  [[nodiscard]] bool write(int socket, std::string_view line);
  void clear() { waiting_.clear(); }

 private:
  std::string waiting_;  // the rest of a line that went in half
};

// Without waiting and async-signal-safe. False: not all of it found room, or nobody is there.
[[nodiscard]] bool send_now(int socket, std::string_view text) noexcept;

}  // namespace cairn::live
