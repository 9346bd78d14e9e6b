// A WebSocket that hands the stream of a running mission on to a browser.
//
// Each has a connection of its own to the mission's control socket, and reads its next line when the browser has taken
// the one before: nothing is queued here, and a browser that is slow gets fewer frames.
#pragma once

#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <filesystem>
#include <memory>
#include <string>

namespace cairn {

using LiveRequest = boost::beast::http::request<boost::beast::http::string_body>;

inline constexpr const char* kLiveProtocol = "cairn.view.1";

// Of the sub-protocols that the request offers, "token.TOKEN"; empty: none. A browser can send no header with it.
[[nodiscard]] std::string live_token_of(const LiveRequest& request);

// Empty: it is served until either end has gone; counted is kept as long. Otherwise why not, and the stream is as it
// was.
[[nodiscard]] std::string serve_live(boost::beast::tcp_stream&& stream, LiveRequest&& request,
                                     const std::filesystem::path& folder, std::shared_ptr<void> counted);

}  // namespace cairn
