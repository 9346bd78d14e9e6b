// A WebSocket to a server, served by a thread of its own: what comes waits here, and what is sent never keeps anybody
// waiting.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace cairn::rosbridge_robot {

struct WebAddress {
  std::string host;
  int port = 0;
  std::string path;
  [[nodiscard]] std::string text() const;  // ws://host:port/path
};

class WebSocket {
 public:
  enum class State { connecting, open, closed };
  // What comes and is not taken is kept up to there; then the oldest goes.
  static constexpr std::size_t kMaxWaiting = std::size_t{64} << 20;  // bytes

  // Begins to connect. A longer message ends the connection.
  WebSocket(const WebAddress& address, std::size_t max_message_bytes);
  // What was sent before goes out first, if it can within 0.2 s.
  ~WebSocket();
  WebSocket(const WebSocket&) = delete;
  WebSocket& operator=(const WebSocket&) = delete;

  [[nodiscard]] State state() const;
  // Of one that is closed: a sentence.
  [[nodiscard]] std::string why() const;
  // What has come, oldest first; waits for it up to that time, or until it is closed.
  [[nodiscard]] std::vector<std::string> take(std::chrono::milliseconds wait_for);

  // From any thread, while it is open. All of them go out, in their order.
  void send(std::string text);
  // The same; one that still waits when the next comes is left out.
  void send_latest(std::string text) noexcept;
  // Of the socket; -1: it is not open.
  [[nodiscard]] int descriptor() const;

 private:
  struct Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace cairn::rosbridge_robot
