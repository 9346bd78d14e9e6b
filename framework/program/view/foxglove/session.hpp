// A WebSocket to a viewer of Foxglove's protocol: Foxglove, Lichtblick, PlotJuggler.
#pragma once

#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/program/view/foxglove/connection.hpp"
#include "framework/program/view/foxglove/offer.hpp"

namespace cairn {

using FoxgloveRequest = boost::beast::http::request<boost::beast::http::string_body>;

// A WebSocket that offers a name of the protocol.
[[nodiscard]] bool is_foxglove(const FoxgloveRequest& request);
// Of its address, `?token=...`, since these viewers can send no header; empty: none.
[[nodiscard]] std::string foxglove_token_of(const FoxgloveRequest& request);

// A run that is under way in the folder is watched, which may be empty; otherwise the offer's recording is played.
// Empty: it is served until it has gone; counted is kept as long. Otherwise why not, and the stream is as it was.
[[nodiscard]] std::string serve_foxglove(boost::beast::tcp_stream&& stream, FoxgloveRequest&& request,
                                         const FoxgloveOffer& offer, const std::filesystem::path& live,
                                         std::shared_ptr<void> counted);

}  // namespace cairn
