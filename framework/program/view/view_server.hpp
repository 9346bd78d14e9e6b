// HTTP on 127.0.0.1, for one page and its API. With live_session.hpp and foxglove/session.hpp the only user of
// Boost.Beast.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "framework/program/view/foxglove/offer.hpp"
#include "framework/program/view/view_request.hpp"

namespace cairn {

inline constexpr std::size_t kMaxViewBody = std::size_t{1} << 20;  // bytes of a request's body
inline constexpr int kMaxViewClients = 16;                         // connections at once; more are refused, then closed
inline constexpr int kViewWorkers = 4;                             // threads that answer
inline constexpr int kViewTimeout_s = 30;                          // for a request to come, and for its answer to go

class ViewServer {
 public:
  // Port 0: a free one. Throws std::runtime_error when it cannot listen. The token: refusal_of(). live: the output
  // folder of a run, whose stream is handed on while it runs; empty: none.
  ViewServer(std::uint16_t port, std::string token, ViewHandler handler, std::filesystem::path live = {});
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  // Before run(): viewers of Foxglove's protocol are served too.
  void offer_foxglove(FoxgloveOffer offer);
  // Answers until `end`. Streams go on while the handler is at work.
  void run(const std::atomic<bool>& end);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cairn
