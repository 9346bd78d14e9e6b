#include "maps/base/base64.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace cairn {
namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) {
  return {text.begin(), text.end()};
}

// The examples of RFC 4648.
TEST(Base64, WritesAndReadsTheExamplesOfItsStandard) {
  const std::vector<std::pair<std::string_view, std::string_view>> examples{{"", ""},
                                                                            {"f", "Zg=="},
                                                                            {"fo", "Zm8="},
                                                                            {"foo", "Zm9v"},
                                                                            {"foob", "Zm9vYg=="},
                                                                            {"fooba", "Zm9vYmE="},
                                                                            {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : examples) {
    EXPECT_EQ(base64(bytes_of(bytes)), text);
    EXPECT_EQ(bytes_of_base64(text), bytes_of(bytes));
  }
}

TEST(Base64, ReadsEveryByteBack) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 256; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(i));
    EXPECT_EQ(bytes_of_base64(base64(bytes)), bytes);
  }
}

TEST(Base64, RefusesWhatItNeverWrites) {
  for (const char* text : {"Zg=", "Zg", "Z===", "====", "Zm9v!A==", "Zh==", "Zg==Zg==", "Zg= ="})
    EXPECT_THROW((void)bytes_of_base64(text), std::invalid_argument) << text;
}

}  // namespace
}  // namespace cairn
