#include "plugins/rosbridge_robot/web_socket.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace cairn::rosbridge_robot {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;

constexpr std::chrono::seconds kConnectWithin{3};
constexpr std::chrono::seconds kIdle{10};  // without a sign of life it is gone; it is asked for one in time
constexpr std::chrono::milliseconds kFlushWithin{200};

}  // namespace

std::string WebAddress::text() const {
  return "ws://" + host + ":" + std::to_string(port) + path;
}

// All but what is under the lock is used by its thread only.
struct WebSocket::Loop {
  explicit Loop(WebAddress where, std::size_t max_message_bytes) : address(std::move(where)) {
    stream.read_message_max(max_message_bytes);
  }

  void connect();
  void connect_to(const tcp::resolver::results_type& found);
  void shake_hands();
  void read();
  void write();
  void close(const char* doing, beast::error_code error);
  void keep(std::string&& text);

  WebAddress address;
  asio::io_context io{1};
  tcp::resolver resolver{io};
  websocket::stream<beast::tcp_stream> stream{io};
  beast::flat_buffer heard;
  std::deque<std::string> queue;
  std::string writing;
  bool is_writing = false;

  std::mutex lock;
  std::condition_variable changed;
  State state = State::connecting;
  std::string why;
  std::deque<std::string> come;
  std::size_t come_bytes = 0;
  std::optional<std::string> latest;
  std::size_t unsent = 0;
  int descriptor = -1;

  std::jthread thread;
};

void WebSocket::Loop::connect() {
  resolver.async_resolve(address.host, std::to_string(address.port),
                         [this](beast::error_code error, const tcp::resolver::results_type& found) {
                           if (error) return close("cannot be found", error);
                           connect_to(found);
                         });
}

void WebSocket::Loop::connect_to(const tcp::resolver::results_type& found) {
  beast::get_lowest_layer(stream).expires_after(kConnectWithin);
  beast::get_lowest_layer(stream).async_connect(found, [this](beast::error_code error, const tcp::endpoint&) {
    if (error) return close("cannot be connected to", error);
    beast::error_code ignored;
    beast::get_lowest_layer(stream).socket().set_option(tcp::no_delay(true), ignored);
    shake_hands();
  });
}

void WebSocket::Loop::shake_hands() {
  beast::get_lowest_layer(stream).expires_never();
  stream.set_option(websocket::stream_base::timeout{kConnectWithin, kIdle, true});
  stream.async_handshake(address.host + ":" + std::to_string(address.port), address.path,
                         [this](beast::error_code error) {
                           if (error) return close("is no WebSocket", error);
                           stream.text(true);
                           {
                             const std::scoped_lock guard(lock);
                             state = State::open;
                             descriptor = beast::get_lowest_layer(stream).socket().native_handle();
                           }
                           changed.notify_all();
                           read();
                           write();
                         });
}

void WebSocket::Loop::read() {
  stream.async_read(heard, [this](beast::error_code error, std::size_t) {
    if (error == websocket::error::message_too_big || error == websocket::error::buffer_overflow)
      return close("sends a message that is longer than `max_message_kib`", {});
    if (error) return close("has ended the connection", error);
    keep(beast::buffers_to_string(heard.data()));
    heard.consume(heard.size());
    read();
  });
}

void WebSocket::Loop::keep(std::string&& text) {
  {
    const std::scoped_lock guard(lock);
    come_bytes += text.size();
    come.push_back(std::move(text));
    while (come_bytes > kMaxWaiting) {
      come_bytes -= come.front().size();
      come.pop_front();
    }
  }
  changed.notify_all();
}

void WebSocket::Loop::write() {
  if (is_writing) return;
  {
    const std::scoped_lock guard(lock);
    if (state != State::open) return;
    if (!queue.empty()) {
      writing = std::move(queue.front());
      queue.pop_front();
    } else if (latest) {
      writing = std::move(*latest);
      latest.reset();
    } else {
      return;
    }
  }
  is_writing = true;
  stream.async_write(asio::buffer(writing), [this](beast::error_code error, std::size_t) {
    is_writing = false;
    {
      const std::scoped_lock guard(lock);
      --unsent;
    }
    changed.notify_all();
    if (error) return close("takes nothing any more", error);
    write();
  });
}

void WebSocket::Loop::close(const char* doing, beast::error_code error) {
  beast::error_code ignored;
  {
    const std::scoped_lock guard(lock);
    if (state == State::closed) return;
    state = State::closed;
    descriptor = -1;
    unsent = 0;
    why = address.text() + " " + doing + (error ? ": " + error.message() : "");
  }
  changed.notify_all();
  beast::get_lowest_layer(stream).socket().close(ignored);
}

WebSocket::WebSocket(const WebAddress& address, std::size_t max_message_bytes)
    : loop_(std::make_unique<Loop>(address, max_message_bytes)) {
  loop_->thread = std::jthread([loop = loop_.get()] {
    loop->connect();
    loop->io.run();
  });
}

WebSocket::~WebSocket() {
  {
    std::unique_lock guard(loop_->lock);
    loop_->changed.wait_for(guard, kFlushWithin, [this] { return loop_->state != State::open || loop_->unsent == 0; });
  }
  loop_->io.stop();
  loop_->thread.join();
}

WebSocket::State WebSocket::state() const {
  const std::scoped_lock guard(loop_->lock);
  return loop_->state;
}

std::string WebSocket::why() const {
  const std::scoped_lock guard(loop_->lock);
  return loop_->why;
}

std::vector<std::string> WebSocket::take(std::chrono::milliseconds wait_for) {
  std::unique_lock guard(loop_->lock);
  loop_->changed.wait_for(guard, wait_for, [this] { return !loop_->come.empty() || loop_->state == State::closed; });
  std::vector<std::string> texts(std::make_move_iterator(loop_->come.begin()),
                                 std::make_move_iterator(loop_->come.end()));
  loop_->come.clear();
  loop_->come_bytes = 0;
  return texts;
}

void WebSocket::send(std::string text) {
  {
    const std::scoped_lock guard(loop_->lock);
    if (loop_->state != State::open) return;
    ++loop_->unsent;
  }
  asio::post(loop_->io, [loop = loop_.get(), text = std::move(text)]() mutable {
    loop->queue.push_back(std::move(text));
    loop->write();
  });
}

void WebSocket::send_latest(std::string text) noexcept {
  try {
    {
      const std::scoped_lock guard(loop_->lock);
      if (loop_->state != State::open) return;
      if (!loop_->latest) ++loop_->unsent;
      loop_->latest = std::move(text);
    }
    asio::post(loop_->io, [loop = loop_.get()] { loop->write(); });
  } catch (const std::exception&) {
    // No memory: the next velocity is sent in 0.05 s, or the guard's zero.
  }
}

int WebSocket::descriptor() const {
  const std::scoped_lock guard(loop_->lock);
  return loop_->descriptor;
}

}  // namespace cairn::rosbridge_robot
