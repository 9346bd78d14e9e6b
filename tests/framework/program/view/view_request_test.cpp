#include "framework/program/view/view_request.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace cairn {
namespace {

constexpr std::uint16_t kPort = 8123;
const std::string kToken(32, 'a');

ViewRequest sound_request() {
  return {"GET", "/api/map", "127.0.0.1:8123", "", kToken, "", ""};
}

TEST(ViewRequest, SoundRequestsAreAnswered) {
  ViewRequest request = sound_request();
  EXPECT_FALSE(refusal_of(request, kPort, kToken));
  request.host = "localhost:8123";
  request.origin = "http://localhost:8123";
  EXPECT_FALSE(refusal_of(request, kPort, kToken));
  request = {"POST", "/api/plan", "[::1]:8123", "", kToken, "application/json", "{}"};
  EXPECT_FALSE(refusal_of(request, kPort, kToken));
}

TEST(ViewRequest, ThePageItselfNeedsNoToken) {
  EXPECT_FALSE(refusal_of({"GET", "/", "127.0.0.1:8123", "", "", "", ""}, kPort, kToken));
}

TEST(ViewRequest, WhatIsRefused) {
  struct Row {
    std::string what;
    ViewRequest request;
    int status;
  };
  const std::string here = "127.0.0.1:8123";
  const std::vector<Row> rows{
      {"no host", {"GET", "/", "", "", kToken, "", ""}, 403},
      {"a name that was made to resolve here", {"GET", "/", "evil.example:8123", "", kToken, "", ""}, 403},
      {"a host that begins like this one", {"GET", "/", "127.0.0.1:8123.evil.example", "", kToken, "", ""}, 403},
      {"a host that ends like this one", {"GET", "/", "evil.localhost:8123", "", kToken, "", ""}, 403},
      {"another port", {"GET", "/", "127.0.0.1:81", "", kToken, "", ""}, 403},
      {"a foreign origin", {"GET", "/", here, "http://evil.example", kToken, "", ""}, 403},
      {"an origin that begins like this one",
       {"GET", "/", here, "http://127.0.0.1:8123.evil.example", kToken, "", ""},
       403},
      {"an origin of another port", {"GET", "/", here, "http://127.0.0.1:81", kToken, "", ""}, 403},
      {"an origin of another scheme", {"GET", "/", here, "https://127.0.0.1:8123", kToken, "", ""}, 403},
      {"the origin of a file", {"GET", "/", here, "null", kToken, "", ""}, 403},
      {"no token", {"GET", "/api/map", here, "", "", "", ""}, 401},
      {"a wrong token", {"GET", "/api/map", here, "", std::string(32, 'b'), "", ""}, 401},
      {"the beginning of the token", {"GET", "/api/map", here, "", std::string(31, 'a'), "", ""}, 401},
      {"a longer token", {"GET", "/api/map", here, "", std::string(33, 'a'), "", ""}, 401},
      {"a plan by GET", {"GET", "/api/plan", here, "", kToken, "application/json", ""}, 405},
      {"a map by POST", {"POST", "/api/map", here, "", kToken, "application/json", ""}, 405},
      {"OPTIONS", {"OPTIONS", "/api/map", here, "", kToken, "", ""}, 405},
      {"a form", {"POST", "/api/plan", here, "", kToken, "application/x-www-form-urlencoded", ""}, 415},
      {"a stream without the token", {"GET", "/live", here, "", "", "", ""}, 401},
      {"a stream for a foreign page", {"GET", "/live", here, "http://evil.example", kToken, "", ""}, 403},
      {"steering without the token", {"POST", "/api/run/pause", here, "", "", "application/json", "{}"}, 401},
      {"steering by GET", {"GET", "/api/run/pause", here, "", kToken, "application/json", ""}, 405},
      {"steering by a form", {"POST", "/api/run/pause", here, "", kToken, "text/plain", "{}"}, 415},
      {"plain text", {"POST", "/api/plan", here, "", kToken, "text/plain", ""}, 415},
  };
  for (const Row& row : rows) {
    const auto refused = refusal_of(row.request, kPort, kToken);
    ASSERT_TRUE(refused) << row.what;
    EXPECT_EQ(refused->status, row.status) << row.what;
  }
}

TEST(ViewRequest, TokensAreLongAndNew) {
  EXPECT_EQ(new_view_token().size(), 32U);
  EXPECT_NE(new_view_token(), new_view_token());
}

TEST(ViewRequest, OriginsAreWrittenAsBrowsersDo) {
  for (const char* origin : {"https://example.org", "http://localhost:8080", "http://[::1]:80"})
    EXPECT_TRUE(is_page_origin(origin)) << origin;
  for (const char* other : {"", "example.org", "https://example.org/", "https://Example.org", "ftp://example.org", "*",
                            "https://a b", "https://example.org:99999999"})
    EXPECT_FALSE(is_page_origin(other)) << other;
}

}  // namespace
}  // namespace cairn
