#include "maps/base/json_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "maps/base/spelling.hpp"

namespace cairn::exchange {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kScalarEnds = " \t\r\n,:[]{}\"";

std::size_t end_of_string(const SourceText& source, std::size_t begin) {
  const std::string_view text = source.text();
  for (std::size_t at = begin + 1; at < text.size(); ++at) {
    if (text[at] == '\\') {
      ++at;
    } else if (text[at] == '"') {
      return at + 1;
    }
  }
  source.fail_cut(begin, "this string is not closed");
}

using Keys = std::vector<std::string_view>;

void check_keys(const SourceText& source, Keys& keys) {
  std::ranges::sort(keys, [](std::string_view a, std::string_view b) { return a != b ? a < b : a.data() < b.data(); });
  const auto twice = std::ranges::adjacent_find(keys);
  if (twice == keys.end()) return;
  source.fail(static_cast<std::size_t>((twice + 1)->data() - source.text().data()),
              "the key " + in_quotes(twice->substr(1, twice->size() - 2)) + " is in this object twice");
}

// The end of the value that begins there, depth brackets deep in the file.
std::size_t end_of_value(const SourceText& source, std::size_t begin, std::size_t depth) {
  const std::string_view text = source.text();
  std::vector<Keys> open;  // the keys of each open bracket
  std::size_t at = begin;
  do {
    at = std::min(text.find_first_not_of(" \t\r\n,:", at), text.size());
    if (at == text.size()) source.fail_cut(begin, "this value is not closed");
    const char c = text[at];
    if (c == '{' || c == '[') {
      if (depth + open.size() >= kMaxJsonDepth)
        source.fail(at, "nests deeper than " + std::to_string(kMaxJsonDepth) + " brackets");
      open.emplace_back();
      ++at;
    } else if (c == '}' || c == ']') {
      if (open.empty()) return at;
      check_keys(source, open.back());
      open.pop_back();
      ++at;
    } else if (c == '"') {
      const std::size_t end = end_of_string(source, at);
      const bool is_key = skip_blanks(source, end) < text.size() && text[skip_blanks(source, end)] == ':';
      if (is_key && !open.empty()) open.back().push_back(text.substr(at, end - at));
      at = end;
    } else {
      at = std::min(text.find_first_of(kScalarEnds, at), text.size());
    }
  } while (!open.empty());
  return at;
}

char next_of(const SourceText& source, std::size_t& at) {
  at = skip_blanks(source, at);
  return at < source.text().size() ? source.text()[at] : '\0';
}

// Over a comma to the next element, or over the closing bracket: then false.
bool next_element(const SourceText& source, std::size_t& at, char closing) {
  const char c = next_of(source, at);
  if (c != ',' && c != closing) {
    const std::string sentence = std::string("expected , or ") + closing;
    if (c == '\0') source.fail_cut(at, sentence);
    source.fail(at, sentence + ", found " + in_quotes(source.text().substr(at, 1)));
  }
  ++at;
  return c == ',';
}

void open_bracket(const SourceText& source, std::size_t& at, char opening, const char* what) {
  const char c = next_of(source, at);
  const std::string sentence = std::string("expected ") + what;
  if (c == '\0') source.fail_cut(at, sentence);
  if (c != opening) source.fail(at, sentence + ", found " + in_quotes(source.text().substr(at, 20)));
  ++at;
}

JsonMember member_at(const SourceText& source, std::size_t& at) {
  JsonMember member;
  if (next_of(source, at) != '"') {
    if (at == source.text().size()) source.fail_cut(at, "expected a key in quotes");
    source.fail(at, "expected a key in quotes, found " + in_quotes(source.text().substr(at, 1)));
  }
  member.key_offset = at;
  at = end_of_string(source, at);
  member.key = source.text().substr(member.key_offset + 1, at - member.key_offset - 2);
  if (next_of(source, at) != ':') source.fail(at, "expected : behind the key " + in_quotes(member.key));
  ++at;
  member.begin = skip_blanks(source, at);
  member.end = at = end_of_value(source, member.begin, 1);
  return member;
}

}  // namespace

std::size_t skip_blanks(const SourceText& source, std::size_t at) {
  return std::min(source.text().find_first_not_of(kBlanks, at), source.text().size());
}

std::vector<JsonMember> members_at(const SourceText& source, std::size_t begin, std::size_t& end) {
  std::vector<JsonMember> members;
  open_bracket(source, begin, '{', "an object, {...}");
  end = begin;
  if (next_of(source, end) == '}') return ++end, members;
  Keys keys;
  do {
    members.push_back(member_at(source, end));
    keys.push_back(source.text().substr(members.back().key_offset, members.back().key.size() + 2));
  } while (next_element(source, end, '}'));
  check_keys(source, keys);
  return members;
}

std::vector<JsonSlice> items_at(const SourceText& source, std::size_t begin) {
  std::vector<JsonSlice> items;
  open_bracket(source, begin, '[', "an array, [...]");
  if (next_of(source, begin) == ']') return items;
  do {
    const std::size_t at = skip_blanks(source, begin);
    begin = end_of_value(source, at, 2);
    items.push_back({at, begin});
  } while (next_element(source, begin, ']'));
  return items;
}

std::size_t offset_of(const SourceText& source, std::size_t begin, const std::vector<std::string>& path) {
  for (const std::string& part : path) {
    if (begin >= source.text().size()) break;
    if (source.text()[begin] == '{') {
      std::size_t end = 0;
      const std::vector<JsonMember> members = members_at(source, begin, end);
      const auto found = std::ranges::find(members, part, [](const JsonMember& member) { return member.key; });
      if (found == members.end()) break;
      begin = found->begin;
    } else if (source.text()[begin] == '[') {
      const std::vector<JsonSlice> items = items_at(source, begin);
      const std::size_t index = std::stoul(part);
      if (index >= items.size()) break;
      begin = items[index].begin;
    } else {
      break;
    }
  }
  return begin;
}

bool is_json_object(std::string_view text) {
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (in_string && c == '\\')
      ++at;
    else if (c == '"')
      in_string = !in_string;
    else if (!in_string && (c == '{' || c == '[') && ++depth > kMaxJsonDepth)
      return false;
    else if (!in_string && (c == '}' || c == ']'))
      --depth;
  }
  return text.starts_with('{') && nlohmann::json::accept(text);
}

}  // namespace cairn::exchange
