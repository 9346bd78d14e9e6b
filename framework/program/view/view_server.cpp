#include "framework/program/view/view_server.hpp"

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <utility>

#include "framework/program/view/foxglove/session.hpp"
#include "framework/program/view/live_session.hpp"

namespace cairn {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using Text = http::string_body;

constexpr std::uint32_t kMaxHeader = 16 * 1024;
constexpr std::chrono::milliseconds kEndCheck{100};

std::string only_value(const http::request<Text>& request, http::field field, const std::string& of_several) {
  const auto count = request.count(field);
  if (count == 0) return {};
  return count == 1 ? std::string(request[field]) : of_several;
}

ViewRequest view_request_of(const http::request<Text>& request) {
  return {std::string(request.method_string()),
          std::string(request.target()),
          only_value(request, http::field::host, ""),
          only_value(request, http::field::origin, "several"),
          request.target() == kLiveTarget ? live_token_of(request) : std::string(request["X-Cairn-Token"]),
          std::string(request[http::field::content_type]),
          request.body()};
}

http::response<Text> http_of(ViewResponse&& answer) {
  http::response<Text> response(static_cast<http::status>(answer.status), 11);
  response.set(http::field::content_type, answer.type);
  response.set(http::field::cache_control, "no-store");
  response.set("Content-Security-Policy",
               "default-src 'self'; img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.keep_alive(false);
  response.body() = std::move(answer.body);
  response.prepare_payload();
  return response;
}

}  // namespace

struct ViewServer::State {
  int clients = 0;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer timer{io};
  std::string token;
  ViewHandler handler;
  std::filesystem::path live;
  std::optional<FoxgloveOffer> foxglove;
  asio::thread_pool workers{kViewWorkers};  // the last: it waits for the answers under way

  class Session;
  void accept();
  void check_end(const std::atomic<bool>& end);
  [[nodiscard]] std::uint16_t port() const { return acceptor.local_endpoint().port(); }
  [[nodiscard]] ViewResponse answer(const ViewRequest& request) const;
};

// One request and its answer.
class ViewServer::State::Session : public std::enable_shared_from_this<Session> {
 public:
  Session(State& state, tcp::socket socket) : state_(state), stream_(std::move(socket)) {
    ++state_.clients;
    parser_.body_limit(kMaxViewBody);
    parser_.header_limit(kMaxHeader);
  }
  ~Session() { --state_.clients; }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void read() {
    stream_.expires_after(std::chrono::seconds(kViewTimeout_s));
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) { self->on_read(error); });
  }

  // One too many.
  void refuse() {
    is_refused_ = true;
    read();
  }

 private:
  void on_read(beast::error_code error) {
    if (error == http::error::body_limit) return write(view_error(413, "the body is longer than 1 MB"));
    if (error == http::error::header_limit) return write(view_error(431, "the header is longer than 16 kB"));
    if (error) return;
    if (is_refused_)
      return write(view_error(429, "so many connections are open already: " + std::to_string(kMaxViewClients)));
    http::request<Text> request = parser_.release();
    if (state_.foxglove && is_foxglove(request)) return go_foxglove(std::move(request));
    ViewRequest asked = view_request_of(request);
    if (auto refused = refusal_of(asked, state_.port(), state_.token)) return write(std::move(*refused));
    if (request.target() == kLiveTarget) return go_live(std::move(request));
    stream_.expires_never();
    asio::post(state_.workers, [self = shared_from_this(), asked = std::move(asked)]() mutable {
      State& state = self->state_;
      auto answer = std::make_shared<ViewResponse>(state.answer(asked));
      // The session goes with it: it must end in the network's thread.
      asio::post(state.io, [self = std::move(self), answer] { self->write(std::move(*answer)); });
    });
  }

  // The connection becomes a WebSocket, which counts as long as it lasts.
  void go_live(http::request<Text>&& request) {
    if (!beast::websocket::is_upgrade(request)) return write(view_error(426, "this is a WebSocket"));
    const std::string why = serve_live(std::move(stream_), std::move(request), state_.live, shared_from_this());
    if (!why.empty()) write(view_error(409, why));
  }

  // The connection becomes a WebSocket, which counts as long as it lasts.
  void go_foxglove(http::request<Text>&& request) {
    ViewRequest asked = view_request_of(http::request<Text>(request));
    asked.target = "/api/foxglove";
    asked.token = foxglove_token_of(request);
    if (std::ranges::count(state_.foxglove->origins, asked.origin) > 0) asked.origin.clear();
    if (auto refused = refusal_of(asked, state_.port(), state_.token)) return write(std::move(*refused));
    stream_.expires_never();
    asio::post(state_.workers, [self = shared_from_this(), request = std::move(request)]() mutable {
      State& state = self->state_;
      auto source = std::make_shared<FoxgloveSource>(foxglove_source(*state.foxglove, state.live));
      asio::post(state.io, [self = std::move(self), request = std::move(request), source] {
        if (!source->why.empty()) return self->write(view_error(409, source->why));
        serve_foxglove(std::move(self->stream_), request, std::move(*source), self->state_.foxglove->services,
                       self->state_.workers.get_executor(), self);
      });
    });
  }

  void write(ViewResponse&& answer) {
    response_ = http_of(std::move(answer));
    stream_.expires_after(std::chrono::seconds(kViewTimeout_s));
    http::async_write(stream_, *response_, [self = shared_from_this()](beast::error_code, std::size_t) {
      beast::error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  State& state_;
  bool is_refused_ = false;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  http::request_parser<Text> parser_;
  std::optional<http::response<Text>> response_;
};

ViewResponse ViewServer::State::answer(const ViewRequest& request) const {
  try {
    return handler(request);
  } catch (const std::exception& error) {
    return view_error(500, error.what());
  }
}

void ViewServer::State::accept() {
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error && clients < kMaxViewClients)
      std::make_shared<Session>(*this, std::move(socket))->read();
    else if (!error && clients < 2 * kMaxViewClients)
      std::make_shared<Session>(*this, std::move(socket))->refuse();
    accept();
  });
}

void ViewServer::State::check_end(const std::atomic<bool>& end) {
  if (end) return io.stop();
  timer.expires_after(kEndCheck);
  timer.async_wait([this, &end](beast::error_code) { check_end(end); });
}

ViewServer::ViewServer(std::uint16_t port, std::string token, ViewHandler handler, std::filesystem::path live)
    : state_(std::make_unique<State>()) {
  state_->token = std::move(token);
  state_->handler = std::move(handler);
  state_->live = std::move(live);
  const tcp::endpoint here(asio::ip::address_v4::loopback(), port);
  try {
    state_->acceptor.open(here.protocol());
    state_->acceptor.set_option(asio::socket_base::reuse_address(true));
    state_->acceptor.bind(here);
    state_->acceptor.listen();
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error("view: cannot listen on 127.0.0.1:" + std::to_string(port) + ": " +
                             error.code().message());
  }
  state_->accept();
}

ViewServer::~ViewServer() = default;

std::uint16_t ViewServer::port() const {
  return state_->acceptor.local_endpoint().port();
}

void ViewServer::offer_foxglove(FoxgloveOffer offer) {
  state_->foxglove = std::move(offer);
}

void ViewServer::run(const std::atomic<bool>& end) {
  state_->check_end(end);
  state_->io.run();
}

}  // namespace cairn
