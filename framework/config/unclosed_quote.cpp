#include "framework/config/unclosed_quote.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <sstream>
#include <string_view>
#include <vector>

namespace cairn {
namespace {

constexpr std::size_t kMaxLinesLookedAt = 100;  // from the end: each costs a parse of what is before it

class NoEvents : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

constexpr int kMaxDocuments = 2;  // more are refused anyway, and in some broken texts the parser finds them without end

// A mark of the document's end is not allowed in a quote, and does no harm elsewhere.
bool ends_in_quote(std::string_view text) {
  std::istringstream stream(std::string(text) + "\n...\n");
  NoEvents nothing;
  try {
    YAML::Parser parser(stream);
    for (int i = 0; i < kMaxDocuments && parser.HandleNextDocument(nothing); ++i) {
    }
  } catch (const YAML::Exception& error) {
    return error.msg == YAML::ErrorMsg::DOC_IN_SCALAR || error.msg == YAML::ErrorMsg::EOF_IN_SCALAR;
  }
  return false;
}

// Of the first quote that can begin a string, from 1.
int column_of_quote(std::string_view line) {
  for (std::size_t at = line.find_first_of("\"'"); at != std::string_view::npos; at = line.find_first_of("\"'", at + 1))
    if (at == 0 || std::string_view(" \t[{,:-").find(line[at - 1]) != std::string_view::npos)
      return static_cast<int>(at) + 1;
  return 1;
}

}  // namespace

std::optional<SourcePlace> unclosed_quote(const std::string& text, const std::string& file) {
  if (text.find_first_of("\"'") == std::string::npos || !ends_in_quote(text)) return std::nullopt;
  std::vector<std::size_t> begins{0};
  for (std::size_t at = text.find('\n'); at != std::string::npos && at + 1 < text.size(); at = text.find('\n', at + 1))
    begins.push_back(at + 1);
  const std::string_view all(text);
  for (std::size_t i = 0; i < begins.size() && i < kMaxLinesLookedAt; ++i) {
    const std::size_t line = begins.size() - 1 - i;
    if (line > 0 && ends_in_quote(all.substr(0, begins[line]))) continue;
    const std::string_view rest = all.substr(begins[line]);
    return SourcePlace{file, static_cast<int>(line) + 1, column_of_quote(rest.substr(0, rest.find('\n')))};
  }
  return SourcePlace{file, static_cast<int>(begins.size()), 1};
}

}  // namespace cairn
