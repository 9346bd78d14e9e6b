// A WebSocket to a viewer of Foxglove's protocol: Foxglove, Lichtblick, PlotJuggler.
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/program/view/foxglove/connection.hpp"
#include "framework/program/view/foxglove/offer.hpp"
#include "framework/program/view/run_stream.hpp"

namespace cairn {

using FoxgloveRequest = boost::beast::http::request<boost::beast::http::string_body>;

// A WebSocket that offers a name of the protocol.
[[nodiscard]] bool is_foxglove(const FoxgloveRequest& request);
// Of its address, `?token=...`, since these viewers can send no header; empty: none.
[[nodiscard]] std::string foxglove_token_of(const FoxgloveRequest& request);

// What a viewer is shown: a run that is under way in the folder, which may be empty; otherwise the offer's recording.
struct FoxgloveSource {
  std::string name;
  RunStream run;
  std::shared_ptr<const PlayedRecording> recording{};  // null: the run, or nothing
  std::string why{};                                   // there is nothing
};
// From any thread; may take long.
[[nodiscard]] FoxgloveSource foxglove_source(const FoxgloveOffer& offer, const std::filesystem::path& live);

// Until the viewer has gone; counted is kept as long. Services are called by the workers, one after the other for each
// viewer, so that none holds up what others are sent.
void serve_foxglove(boost::beast::tcp_stream&& stream, const FoxgloveRequest& request, FoxgloveSource&& source,
                    const FoxgloveServices& services, const boost::asio::any_io_executor& workers,
                    std::shared_ptr<void> counted);

}  // namespace cairn
