#include "framework/program/mission/watch_stream.hpp"

#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "framework/program/mission/control_socket.hpp"
#include "framework/program/mission/watch_text.hpp"
#include "maps/base/spelling.hpp"

namespace cairn {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kAliveEvery(1000);
constexpr milliseconds kStatusEvery(1000);
constexpr milliseconds kLastLinesWithin(500);
constexpr std::int64_t kMaxEvery_ms = 10'000;

}  // namespace

bool is_watch_request(const std::string& command) {
  if (command == "watch") return true;
  const nlohmann::json json = nlohmann::json::parse(command, nullptr, false);
  return json.is_object() && json.contains("watch");
}

WatchRequest watch_request_of(const std::string& command) {
  WatchRequest request;
  if (command == "watch") return request;
  const nlohmann::json json = nlohmann::json::parse(command);
  const nlohmann::json& settings = json["watch"];
  if (json.size() != 1 || !settings.is_object())
    throw std::invalid_argument("a watch is asked for as {\"watch\": {\"every_ms\": 50}}");
  for (const auto& [key, value] : settings.items()) {
    if (key != "every_ms")
      throw std::invalid_argument("watch: unknown setting " + in_quotes(key) + did_you_mean(key, {"every_ms"}) +
                                  "; known is: every_ms");
    if (!value.is_number_integer() || value.get<std::int64_t>() < 0 || value.get<std::int64_t>() > kMaxEvery_ms)
      throw std::invalid_argument("watch: every_ms must be a whole number from 0 to " + std::to_string(kMaxEvery_ms));
    request.every = milliseconds(value.get<std::int64_t>());
  }
  return request;
}

WatchStream::WatchStream(Descriptor connection, std::unique_ptr<WatchSource::Watch> watch, WatchRequest request,
                         std::string first_line, RunControl& control)
    : connection_(std::move(connection)), watch_(std::move(watch)), request_(request), control_(control) {
  const timeval at_most{kWatchSendWithin.count(), 0};
  ::setsockopt(connection_.get(), SOL_SOCKET, SO_SNDTIMEO, &at_most, sizeof at_most);
  thread_ = std::thread([this, line = std::move(first_line)] { send_all(line); });
}

WatchStream::~WatchStream() {
  ::shutdown(connection_.get(), SHUT_RDWR);
  thread_.join();
}

void WatchStream::send_all(const std::string& first_line) {
  if (write_line(connection_.get(), first_line) && send_frames())
    write_line(connection_.get(), WatchText::end_line(control_.status(milliseconds(0))));
  watch_.reset();
  ::shutdown(connection_.get(), SHUT_RDWR);
  has_ended_ = true;
}

// False when the other end has gone.
bool WatchStream::send_frames() {
  WatchText text;
  Clock::time_point next_status = Clock::now();
  while (!watch_->has_ended()) {
    const Clock::time_point begin = Clock::now();
    const bool with_status = begin >= next_status;
    const std::shared_ptr<const WatchFrame> frame = watch_->next(kAliveEvery, with_status);
    if (with_status && frame) next_status = begin + kStatusEvery;
    if (!frame && watch_->has_ended()) return true;
    const std::string line = frame ? text.line_of(*frame) : WatchText::alive_line(control_.status(milliseconds(0)));
    if (!write_line(connection_.get(), line)) return false;
    if (frame && !frame->is_last) std::this_thread::sleep_until(begin + request_.every);
  }
  return true;
}

void wait_for_last_lines(const std::list<WatchStream>& streams) {
  const Clock::time_point until = Clock::now() + kLastLinesWithin;
  while (Clock::now() < until && !std::ranges::all_of(streams, &WatchStream::has_ended))
    std::this_thread::sleep_for(milliseconds(1));
}

}  // namespace cairn
