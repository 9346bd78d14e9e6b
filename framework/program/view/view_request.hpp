// What a viewer's browser asks, and which requests are refused before anything answers them.
//
// The view listens on this machine only. A page of a stranger in the same browser can send requests there, so every
// request needs the right Host (a name that was made to resolve to 127.0.0.1 has another), no foreign Origin, and for
// all but the page itself the token of the printed address. Names are compared as whole strings.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace cairn {

inline constexpr const char* kLiveTarget = "/live";       // a WebSocket with the stream of a running mission
inline constexpr const char* kSteerTarget = "/api/run/";  // with a command of its control socket behind it
inline constexpr const char* kEditTarget = "/api/edit/";  // with a change of a saved map behind it

struct ViewRequest {
  std::string method;
  std::string target;  // with its query
  std::string host;    // empty: none, or several
  std::string origin;  // empty: none, as of programs that are no browser
  std::string token;   // of the header X-Cairn-Token; of a WebSocket, of its sub-protocol "token.TOKEN"
  std::string content_type;
  std::string body;
};

struct ViewResponse {
  int status = 200;  // of HTTP
  std::string type = "application/json";
  std::string body;
};

// Called by several threads at once.
using ViewHandler = std::function<ViewResponse(const ViewRequest& request)>;

// 128 random bits in hexadecimal.
[[nodiscard]] std::string new_view_token();

// As browsers write the origin of a page: "https://example.org", "http://localhost:8080".
[[nodiscard]] bool is_page_origin(const std::string& text);

// {"error": why}
[[nodiscard]] ViewResponse view_error(int status, const std::string& why);

// None: it may be answered. 403 for a foreign Host or Origin, 401 without the token, 405 for a method that its target
// does not have, 415 for a POST that is not application/json.
[[nodiscard]] std::optional<ViewResponse> refusal_of(const ViewRequest& request, std::uint16_t port,
                                                     const std::string& token);

}  // namespace cairn
