// One connection to the control socket that has become a stream of what the mission does.
#pragma once

#include <atomic>
#include <chrono>
#include <list>
#include <memory>
#include <string>
#include <thread>

#include "framework/live/descriptor.hpp"
#include "framework/mission/run_control.hpp"
#include "framework/reporting/watching/watch_source.hpp"

namespace cairn {

inline constexpr std::size_t kMaxWatches = 8;                // of a run, at once
inline constexpr std::chrono::seconds kWatchSendWithin(10);  // of a line; one who is slower is disconnected

struct WatchRequest {
  std::chrono::milliseconds every{50};  // between two frames, at least
};
// Of the command `watch`, or {"watch": {"every_ms": 100}}. Throws std::invalid_argument that says what is wrong.
[[nodiscard]] WatchRequest watch_request_of(const std::string& command);
[[nodiscard]] bool is_watch_request(const std::string& command);

class WatchStream {
 public:
  // Starts its thread, which sends until the run ends or the other end has gone. Throws std::system_error when there is
  // no thread left. The control must outlive it.
  WatchStream(Descriptor connection, std::unique_ptr<WatchSource::Watch> watch, WatchRequest request,
              std::string first_line, RunControl& control);
  WatchStream(const WatchStream&) = delete;
  WatchStream& operator=(const WatchStream&) = delete;
  // The source must have ended, or the stream itself. What is not sent by then is cut off.
  ~WatchStream();

  [[nodiscard]] bool has_ended() const { return has_ended_; }

 private:
  void send_all(const std::string& first_line);
  [[nodiscard]] bool send_frames();

  Descriptor connection_;
  std::unique_ptr<WatchSource::Watch> watch_;
  WatchRequest request_;
  RunControl& control_;
  std::atomic<bool> has_ended_{false};
  std::thread thread_;
};

// After the source has ended: until all have sent what is left, or half a second has passed.
void wait_for_last_lines(const std::list<WatchStream>& streams);

}  // namespace cairn
