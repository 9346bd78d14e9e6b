#include "framework/program/view/live_session.hpp"

#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <utility>

#include "framework/program/view/run_stream.hpp"

namespace cairn {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

constexpr std::size_t kMaxHeard = 1024;  // of a message from the browser, which has nothing to say
constexpr std::chrono::seconds kIdle(20);
constexpr const char* kTokenPrefix = "token.";

std::vector<std::string> protocols_of(const LiveRequest& request) {
  std::vector<std::string> protocols;
  for (const auto& protocol : http::token_list(request[http::field::sec_websocket_protocol]))
    protocols.emplace_back(protocol);
  return protocols;
}

class LiveSession : public std::enable_shared_from_this<LiveSession> {
 public:
  // Takes the descriptor.
  LiveSession(beast::tcp_stream&& stream, int run, std::shared_ptr<void> counted)
      : browser_(std::move(stream)), run_(browser_.get_executor()), counted_(std::move(counted)) {
    run_.assign(asio::local::stream_protocol(), run);
  }

  void accept(const LiveRequest& request) {
    beast::get_lowest_layer(browser_).expires_never();
    browser_.set_option(websocket::stream_base::timeout{kIdle, kIdle, true});
    browser_.set_option(websocket::stream_base::decorator(
        [](websocket::response_type& response) { response.set(http::field::sec_websocket_protocol, kLiveProtocol); }));
    browser_.read_message_max(kMaxHeard);
    browser_.text(true);
    browser_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->listen();
      self->hand_on();
    });
  }

 private:
  // Until it closes.
  void listen() {
    browser_.async_read(heard_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->end();
      self->heard_.clear();
      self->listen();
    });
  }

  void hand_on() {
    asio::async_read_until(run_, asio::dynamic_buffer(text_, kMaxRunLine), '\n',
                           [self = shared_from_this()](beast::error_code error, std::size_t size) {
                             if (error) return self->close();
                             self->send(size);
                           });
  }

  void send(std::size_t size) {
    browser_.async_write(asio::buffer(text_.data(), size - 1),
                         [self = shared_from_this(), size](beast::error_code error, std::size_t) {
                           if (error) return self->end();
                           self->text_.erase(0, size);
                           self->hand_on();
                         });
  }

  void close() {
    if (is_closing_) return;
    is_closing_ = true;
    browser_.async_close(websocket::close_code::normal, [self = shared_from_this()](beast::error_code) {});
  }

  void end() {
    beast::error_code ignored;
    run_.close(ignored);
  }

  websocket::stream<beast::tcp_stream> browser_;
  asio::local::stream_protocol::socket run_;
  std::shared_ptr<void> counted_;
  beast::flat_buffer heard_;
  std::string text_;
  bool is_closing_ = false;
};

}  // namespace

std::string live_token_of(const LiveRequest& request) {
  for (const std::string& protocol : protocols_of(request))
    if (protocol.starts_with(kTokenPrefix)) return protocol.substr(std::string_view(kTokenPrefix).size());
  return {};
}

std::string serve_live(beast::tcp_stream&& stream, LiveRequest&& request, const std::filesystem::path& folder,
                       std::shared_ptr<void> counted) {
  const RunStream run = watch_run(folder);
  if (run.descriptor < 0) return run.why;
  std::make_shared<LiveSession>(std::move(stream), run.descriptor, std::move(counted))->accept(request);
  return {};
}

}  // namespace cairn
