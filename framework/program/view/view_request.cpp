#include "framework/program/view/view_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>

namespace cairn {
namespace {

bool is_own_host(const std::string& host, std::uint16_t port) {
  const std::array<std::string, 3> names{"127.0.0.1", "localhost", "[::1]"};
  return std::ranges::any_of(names, [&](const std::string& name) { return host == fmt::format("{}:{}", name, port); });
}

// In a time that does not depend on where they differ.
bool is_same_token(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    differences |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return differences == 0;
}

}  // namespace

std::string new_view_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", static_cast<std::uint32_t>(random()));
  return token;
}

bool is_page_origin(const std::string& text) {
  static const std::regex kOrigin(R"(https?://([a-z0-9.-]+|\[[0-9a-f:]+\])(:[0-9]{1,5})?)");
  return std::regex_match(text, kOrigin);
}

ViewResponse view_error(int status, const std::string& why) {
  const nlohmann::ordered_json json{{"error", why}};
  return {status, "application/json", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"};
}

std::optional<ViewResponse> refusal_of(const ViewRequest& request, std::uint16_t port, const std::string& token) {
  if (!is_own_host(request.host, port)) return view_error(403, "Host is not this view");
  if (!request.origin.empty() && request.origin != "http://" + request.host)
    return view_error(403, "Origin is not this view");
  const bool is_api = request.target.starts_with("/api/") || request.target == kLiveTarget;
  if (is_api && !is_same_token(request.token, token))
    return view_error(401, "the header X-Cairn-Token must hold the token of the printed address");
  const bool is_post = request.target == "/api/plan" || request.target.starts_with(kSteerTarget) ||
                       request.target.starts_with(kEditTarget);
  const std::string method = is_post ? "POST" : "GET";
  if (request.method != method) return view_error(405, "the method must be " + method);
  if (method == "POST" && request.content_type != "application/json")
    return view_error(415, "Content-Type must be application/json");
  return std::nullopt;
}

}  // namespace cairn
