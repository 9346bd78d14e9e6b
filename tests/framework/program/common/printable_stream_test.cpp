#include "framework/program/common/printable_stream.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace cairn {
namespace {

TEST(PrintableStream, ForeignTextCannotSteerATerminal) {
  std::ostringstream out;
  {
    const PrintableStream guard(out);
    out << "name \x1B]0;owned\x07 and \xC2\x9B"
        << "31m, " << 'x' << "\xE2\x80\xAE"
        << "\r\n";
  }
  EXPECT_EQ(out.str(), "name \\x1b]0;owned\\x07 and \\u009b31m, x\\u202e\\x0d\n");
}

TEST(PrintableStream, OtherTextIsUnchangedAlsoWhereItComesInPieces) {
  const std::string text = "K\xC3\xBC\x63he, \xF0\x9F\x97\xBA\tend\n";
  std::ostringstream out;
  {
    const PrintableStream guard(out);
    for (const char c : text) out.put(c);
    out << text << std::flush;
  }
  EXPECT_EQ(out.str(), text + text);
}

TEST(PrintableStream, ACharacterThatIsNeverCompleteIsEscapedAtTheEnd) {
  std::ostringstream out;
  {
    const PrintableStream guard(out);
    out << "a\xF0\x9F" << std::flush;
  }
  EXPECT_EQ(out.str(), "a\\xf0\\x9f");
}

TEST(PrintableStream, JsonKeepsItsValues) {
  const nlohmann::json said = {{"name", "\x1B[2J\x7F\xC2\x9B\xE2\x80\xAE \xC3\xBC"}};
  std::ostringstream out;
  {
    const PrintableStream guard(out);
    out << said.dump() << "\n";
  }
  EXPECT_EQ(out.str(), "{\"name\":\"\\u001b[2J\\u007f\\u009b\\u202e \xC3\xBC\"}\n");
  EXPECT_EQ(nlohmann::json::parse(out.str()), said);
}

TEST(PrintableStream, WhoDrawsOnTheTerminalReachesIt) {
  std::ostringstream out;
  EXPECT_EQ(terminal_of(out), out.rdbuf());
  const PrintableStream guard(out);
  std::ostream terminal(terminal_of(out));
  terminal << "\rdrawn";
  EXPECT_EQ(out.str(), "\rdrawn");
}

}  // namespace
}  // namespace cairn
