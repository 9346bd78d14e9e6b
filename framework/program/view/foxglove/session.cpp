#include "framework/program/view/foxglove/session.hpp"

#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <utility>

#include "framework/program/view/foxglove/live_connection.hpp"
#include "framework/program/view/foxglove/playback.hpp"
#include "framework/program/view/view_request.hpp"

namespace cairn {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{20};
constexpr std::chrono::seconds kIdle{20};  // without a sign of life, then it has gone
constexpr std::size_t kMaxHeard = std::size_t{1} << 20;
constexpr std::size_t kMaxQueued = std::size_t{1} << 20;    // bytes, of playback
constexpr std::size_t kMaxCalls = 64;                       // of services that wait
constexpr std::size_t kMaxAnswers = std::size_t{64} << 20;  // bytes, of all: beyond, the viewer asks and does not read

// The first of the viewer's list that is known here; empty: none.
std::string chosen_protocol(const FoxgloveRequest& request) {
  for (const auto& name : http::token_list(request[http::field::sec_websocket_protocol]))
    if (name == foxglove_protocol::kName || name == foxglove_protocol::kOldName) return std::string(name);
  return {};
}

class FoxgloveSession : public std::enable_shared_from_this<FoxgloveSession> {
 public:
  FoxgloveSession(beast::tcp_stream&& stream, std::string protocol, std::unique_ptr<FoxgloveConnection> connection,
                  asio::any_io_executor workers, std::shared_ptr<void> counted)
      : viewer_(std::move(stream)),
        workers_(std::move(workers)),
        timer_(viewer_.get_executor()),
        run_(viewer_.get_executor()),
        protocol_(std::move(protocol)),
        connection_(std::move(connection)),
        counted_(std::move(counted)) {}

  // Before accept(): the connection hears the run's stream. Takes the descriptor.
  void watch(int run) {
    run_.assign(asio::local::stream_protocol(), run);
    live_ = static_cast<LiveConnection*>(connection_.get());
  }

  void accept(const FoxgloveRequest& request) {
    beast::get_lowest_layer(viewer_).expires_never();
    viewer_.set_option(websocket::stream_base::timeout{kIdle, kIdle, true});
    viewer_.set_option(websocket::stream_base::decorator([name = protocol_](websocket::response_type& response) {
      response.set(http::field::sec_websocket_protocol, name);
    }));
    viewer_.read_message_max(kMaxHeard);
    viewer_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->send(self->connection_->greeting());
      self->listen();
      self->last_ = Clock::now();
      self->tick();
      if (self->live_ != nullptr) self->hear_run();
    });
  }

 private:
  void listen() {
    viewer_.async_read(heard_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->end();
      std::string said = beast::buffers_to_string(self->heard_.data());
      self->heard_.consume(self->heard_.size());
      self->take(std::move(said));
      self->listen();
    });
  }

  void take(std::string&& said) {
    if (viewer_.got_text()) return send(connection_->on_text(said));
    const auto asked = foxglove_protocol::service_call_of(said);
    if (!asked) return send(connection_->on_binary(said));
    if (calls_.size() >= kMaxCalls)
      return send({foxglove_protocol::service_failure(asked->service, asked->call, "so many calls wait already")});
    calls_.push_back(std::move(said));
    if (calls_.size() == 1) call();
  }

  // A plan takes long.
  void call() {
    asio::post(workers_, [self = shared_from_this(), frame = calls_.front()]() mutable {
      auto answer = std::make_shared<FoxgloveConnection::Frames>(self->connection_->on_binary(frame));
      const auto network = self->viewer_.get_executor();
      // The session goes with it: it must end in the network's thread.
      asio::post(network, [self = std::move(self), answer] {
        self->calls_.pop_front();
        self->send(std::move(*answer));
        if (!self->calls_.empty()) self->call();
      });
    });
  }

  // A line more when the viewer has room for it: the run keeps what changes, and sends it later at once.
  void hear_run() {
    if (is_ended_) return;
    asio::async_read_until(run_, asio::dynamic_buffer(text_, kMaxRunLine), '\n',
                           [self = shared_from_this()](beast::error_code error, std::size_t size) {
                             if (error) return self->leave();
                             self->send(self->live_->take(std::string_view(self->text_).substr(0, size)));
                             self->text_.erase(0, size);
                             self->is_run_heard_ = self->queued_ < kMaxQueued;
                             if (self->is_run_heard_) self->hear_run();
                           });
  }

  // The run has ended: a viewer that comes again is played what it has left.
  void leave() {
    if (!queue_.empty()) {
      is_leaving_ = true;
      return;
    }
    viewer_.async_close(websocket::close_code::normal, [self = shared_from_this()](beast::error_code) { self->end(); });
  }

  void tick() {
    if (is_ended_) return;
    const auto now = Clock::now();
    const double elapsed_s = std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    if (queued_ < kMaxQueued) send(connection_->advance(elapsed_s, kMaxQueued));
    if (live_ != nullptr && !is_run_heard_ && queued_ < kMaxQueued) {
      is_run_heard_ = true;
      hear_run();
    }
    timer_.expires_after(kTick);
    timer_.async_wait([self = shared_from_this()](beast::error_code error) {
      if (!error) self->tick();
    });
  }

  void send(FoxgloveConnection::Frames&& frames) {
    for (foxglove_protocol::Frame& frame : frames) {
      queued_ += frame.bytes.size();
      queue_.push_back(std::move(frame));
    }
    if (queued_ > kMaxAnswers) {
      beast::error_code ignored;
      beast::get_lowest_layer(viewer_).socket().close(ignored);
      return end();
    }
    if (!is_writing_) write();
  }

  void write() {
    if (is_ended_) return;
    if (queue_.empty()) {
      if (is_leaving_) leave();
      return;
    }
    is_writing_ = true;
    viewer_.text(queue_.front().is_text);
    viewer_.async_write(asio::buffer(queue_.front().bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->is_writing_ = false;
                          if (error) return self->end();
                          self->queued_ -= self->queue_.front().bytes.size();
                          self->queue_.pop_front();
                          self->write();
                        });
  }

  void end() {
    is_ended_ = true;
    beast::error_code ignored;
    run_.close(ignored);
    timer_.cancel();
  }

  websocket::stream<beast::tcp_stream> viewer_;
  asio::any_io_executor workers_;
  asio::steady_timer timer_;
  asio::local::stream_protocol::socket run_;
  std::string protocol_;
  std::unique_ptr<FoxgloveConnection> connection_;
  LiveConnection* live_ = nullptr;  // the same, of a run
  std::string text_;                // of the run
  std::shared_ptr<void> counted_;
  beast::flat_buffer heard_;
  std::deque<std::string> calls_;  // of services, as they were heard; the first is under way
  std::deque<foxglove_protocol::Frame> queue_;
  std::size_t queued_ = 0;
  Clock::time_point last_;
  bool is_writing_ = false;
  bool is_run_heard_ = true;  // asked for its next line
  bool is_leaving_ = false;
  bool is_ended_ = false;
};

}  // namespace

bool is_foxglove(const FoxgloveRequest& request) {
  return websocket::is_upgrade(request) && !chosen_protocol(request).empty();
}

std::string foxglove_token_of(const FoxgloveRequest& request) {
  constexpr std::string_view kToken = "token=";
  const std::string_view target(request.target().data(), request.target().size());
  std::size_t begin = target.find('?');
  while (begin != std::string_view::npos) {
    const std::string_view rest = target.substr(begin + 1);
    const std::string_view field = rest.substr(0, rest.find('&'));
    if (field.starts_with(kToken)) return std::string(field.substr(kToken.size()));
    begin = target.find('&', begin + 1);
  }
  return {};
}

FoxgloveSource foxglove_source(const FoxgloveOffer& offer, const std::filesystem::path& live) {
  FoxgloveSource source{live.filename().string(), watch_run(live)};
  try {
    if (source.run.descriptor < 0) source.recording = offer.recording();
  } catch (const std::exception& error) {
    source.why = error.what();
  }
  return source;
}

void serve_foxglove(beast::tcp_stream&& stream, const FoxgloveRequest& request, FoxgloveSource&& source,
                    const FoxgloveServices& services, const asio::any_io_executor& workers,
                    std::shared_ptr<void> counted) {
  const std::string protocol = chosen_protocol(request);
  std::unique_ptr<FoxgloveConnection> connection;
  if (source.recording)
    connection = std::make_unique<PlaybackConnection>(source.recording, protocol == foxglove_protocol::kName,
                                                      new_view_token(), services);
  else
    connection = std::make_unique<LiveConnection>(source.name, new_view_token(), services);
  const auto session = std::make_shared<FoxgloveSession>(std::move(stream), protocol, std::move(connection), workers,
                                                         std::move(counted));
  if (!source.recording) session->watch(source.run.descriptor);
  session->accept(request);
}

}  // namespace cairn
