#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "framework/config/config_value.hpp"
#include "framework/config/unclosed_quote.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/source_text.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{16} << 20U;
constexpr std::string_view kPackedByGzip = "\x1f\x8b";
constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxValues = 1'000'000;
constexpr std::string_view kInScalars("\n\t\r\0", 4);  // where a byte 0 is wrong, it is said by what it is wrong for

// Builds the tree from the parser's events, so that no recursion of ours or of the parser goes
// deeper than kMaxDepth and every alias is paid for before it is copied.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] ConfigValue take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(mark, "a second YAML document begins here; a file holds one");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    ConfigValue value = begin(ConfigValue::Kind::null, mark, "");
    // The parser stands behind the gap already; the key or the list before it is what people look for.
    if (!open_.empty()) value.place = open_.back().key ? open_.back().key->key_place : open_.back().value.place;
    finish(std::move(value), anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    if (const std::size_t found = first_unprintable(text, kInScalars); found != std::string::npos)
      fail(mark, "the text " + in_quotes(text) + " holds " + name_of_unprintable(text, found));
    ConfigValue value = begin(ConfigValue::Kind::scalar, mark, tag);
    value.scalar = text;
    value.quoted = tag == kQuotedTag || tag == kTextTag;
    finish(std::move(value), anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(ConfigValue::Kind::list, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(ConfigValue::Kind::map, mark, tag, anchor);
  }
  void OnMapEnd() override { close(); }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto known = anchored_.find(anchor);
    if (known == anchored_.end()) fail(mark, "an alias stands within its own anchor; a value cannot hold itself");
    const Size size = size_of(known->second);
    if (open_.size() + size.depth > kMaxDepth) fail_too_deep(mark);
    count_values(place_of(mark), size.values);
    finish(known->second, YAML::NullAnchor);
  }

 private:
  static constexpr const char* kPlainTag = "?";
  static constexpr const char* kQuotedTag = "!";
  static constexpr const char* kTextTag = "tag:yaml.org,2002:str";

  struct Open {
    ConfigValue value;
    YAML::anchor_t anchor = YAML::NullAnchor;
    std::optional<ConfigValue::Entry> key;  // whose value comes next
    std::set<std::string> keys;
  };
  struct Size {
    std::size_t values = 1;
    std::size_t depth = 0;
  };

  [[nodiscard]] SourcePlace place_of(const YAML::Mark& mark) const { return {file_, mark.line + 1, mark.column + 1}; }
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& sentence) const {
    throw ConfigError(place_of(mark), sentence);
  }
  [[noreturn]] void fail_too_deep(const YAML::Mark& mark) const {
    fail(mark, "nested deeper than " + std::to_string(kMaxDepth) + " levels");
  }

  void count_values(const SourcePlace& place, std::size_t more) {
    values_ += more;
    if (values_ > kMaxValues)
      throw ConfigError(place, "more than " + std::to_string(kMaxValues) + " values in one file");
  }

  static Size size_of(const ConfigValue& value) {
    Size size;
    const auto include = [&size](const Size& inner) {
      size.values += inner.values;
      size.depth = std::max(size.depth, inner.depth);
    };
    for (const ConfigValue& item : value.items) include(size_of(item));
    for (const ConfigValue::Entry& entry : value.entries) include(size_of(entry.value));
    if (value.kind == ConfigValue::Kind::list || value.kind == ConfigValue::Kind::map) ++size.depth;
    return size;
  }

  ConfigValue begin(ConfigValue::Kind kind, const YAML::Mark& mark, const std::string& tag) {
    const bool is_scalar = kind == ConfigValue::Kind::scalar;
    if (!tag.empty() && tag != kPlainTag && !(is_scalar && (tag == kQuotedTag || tag == kTextTag))) {
      fail(mark, "the YAML tag " + in_quotes(tag) + " is not supported");
    }
    count_values(place_of(mark), 1);
    ConfigValue value;
    value.kind = kind;
    value.place = place_of(mark);
    return value;
  }

  void open(ConfigValue::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (open_.size() >= kMaxDepth) fail_too_deep(mark);
    Open container;
    container.value = begin(kind, mark, tag);
    container.anchor = anchor;
    if (expects_key()) fail_key(container.value);
    open_.push_back(std::move(container));
  }

  void close() {
    Open container = std::move(open_.back());
    open_.pop_back();
    finish(std::move(container.value), container.anchor);
  }

  void finish(ConfigValue value, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      // Kept copies cost memory too.
      count_values(value.place, size_of(value).values);
      anchored_[anchor] = value;
    }
    if (open_.empty()) {
      root_ = std::move(value);
    } else if (open_.back().value.kind == ConfigValue::Kind::list) {
      open_.back().value.items.push_back(std::move(value));
    } else if (expects_key()) {
      take_key(value);
    } else {
      Open& map = open_.back();
      map.key->value = std::move(value);
      map.value.entries.push_back(std::move(*map.key));
      map.key.reset();
    }
  }

  [[nodiscard]] bool expects_key() const {
    return !open_.empty() && open_.back().value.kind == ConfigValue::Kind::map && !open_.back().key;
  }
  [[noreturn]] static void fail_key(const ConfigValue& key) {
    // To the parser "[1, 2" without its end looks like a key.
    const std::string hint = key.kind == ConfigValue::Kind::null ? "" : "; is a bracket left open?";
    throw ConfigError(key.place, "a key must be text, found " + key.kind_name() + hint);
  }

  void take_key(const ConfigValue& key) {
    Open& map = open_.back();
    if (key.kind != ConfigValue::Kind::scalar) fail_key(key);
    if (key.scalar == "<<" && !key.quoted) {
      throw ConfigError(key.place, "YAML merge keys (\"<<\") are not supported; write the keys out");
    }
    if (!map.keys.insert(key.scalar).second) {
      const auto first = std::ranges::find(map.value.entries, key.scalar, &ConfigValue::Entry::key);
      throw ConfigError(key.place, "the key " + in_quotes(key.scalar) + " stands here twice; first at line " +
                                       std::to_string(first->key_place.line));
    }
    map.key = ConfigValue::Entry{key.scalar, key.place, {}};
  }

  std::string file_;
  int documents_ = 0;
  std::size_t values_ = 0;
  ConfigValue root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, ConfigValue> anchored_;
};

// Bytes of the UTF-8 character that begins at `at`, or 0 when there is none.
std::size_t character_bytes(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  const std::size_t length = first < 0x80U   ? 1
                             : first < 0xC2U ? 0
                             : first < 0xE0U ? 2
                             : first < 0xF0U ? 3
                             : first < 0xF5U ? 4
                                             : 0;
  if (length == 0 || at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return 0;
  }
  const bool overlong = (first == 0xE0U && byte(at + 1) < 0xA0U) || (first == 0xF0U && byte(at + 1) < 0x90U);
  const bool surrogate = first == 0xEDU && byte(at + 1) >= 0xA0U;
  const bool beyond_unicode = first == 0xF4U && byte(at + 1) >= 0x90U;
  return overlong || surrogate || beyond_unicode ? 0 : length;
}

// The parser takes some control characters for the end of the text, and looks ahead over any
// number of open brackets before it reports the first.
void check_text(const std::string& text, const std::string& file) {
  SourcePlace place{file, 1, 1};
  constexpr int kHopelessBrackets = 1000;
  int brackets = 0;
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const std::size_t bytes = character_bytes(text, at);
    if (bytes == 0) throw ConfigError(place, "not UTF-8 text");
    const std::string_view character = std::string_view(text).substr(at, bytes);
    if (first_unprintable(character, kLineCharacters) != std::string_view::npos)
      throw ConfigError(place, "a control character " + in_quotes(character) + "; a file holds text only");
    if (byte == '[' || byte == '{') ++brackets;
    if (byte == ']' || byte == '}') brackets = std::max(0, brackets - 1);
    if (brackets > kHopelessBrackets) {
      throw ConfigError(place, "nested deeper than " + std::to_string(kMaxDepth) + " levels");
    }
    place.column += 1;
    if (byte == '\n') place = {file, place.line + 1, 1};
    at += bytes;
  }
}

std::string near_files(const std::filesystem::path& file) {
  std::vector<std::string> names;
  std::error_code error;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  for (auto at = std::filesystem::directory_iterator(folder, error);
       !error && at != std::filesystem::directory_iterator(); at.increment(error)) {
    names.push_back(at->path().filename().string());
  }
  std::ranges::sort(names);
  return did_you_mean(file.filename().string(), names);
}

std::string unpacked(const std::filesystem::path& file, const SourcePlace& place) {
  try {
    return exchange::text_of_file(file, kMaxFileBytes);
  } catch (const ExchangeError& error) {
    const std::string_view sentence = error.what();
    throw ConfigError(place, std::string(sentence.substr(file.string().size() + 2)));
  }
}

std::string text_of(const std::filesystem::path& file) {
  const SourcePlace place{file.string(), 0, 0};
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw ConfigError(place, "no such file" + near_files(file));
  if (std::filesystem::is_directory(file, error)) throw ConfigError(place, "a folder, not a file");
  if (exchange::may_never_open(file)) throw ConfigError(place, "no file: a pipe, a socket or a device");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw ConfigError(place, std::string("cannot be read: ") + std::strerror(errno));
  std::string text;
  std::array<char, 65536> block{};
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kMaxFileBytes) throw ConfigError(place, "larger than 16 MiB");
  }
  if (stream.bad()) throw ConfigError(place, "cannot be read to its end");
  return text.starts_with(kPackedByGzip) && std::filesystem::is_regular_file(file, error) ? unpacked(file, place)
                                                                                          : text;
}

void check_quotes(const std::string& text, const std::string& file) {
  if (const auto place = unclosed_quote(text, file))
    throw ConfigError(*place, "the quote that is opened here is never closed");
}

}  // namespace

ConfigValue parse_config_text(const std::string& text, const std::string& file_name) {
  if (text.size() > kMaxFileBytes) throw ConfigError({file_name, 0, 0}, "larger than 16 MiB");
  check_text(text, file_name);
  TreeBuilder builder(file_name);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    check_quotes(text, file_name);
    SourcePlace place{file_name, 0, 0};
    if (!error.mark.is_null()) place = {file_name, error.mark.line + 1, error.mark.column + 1};
    throw ConfigError(place, "not valid YAML: " + error.msg);
  }
  check_quotes(text, file_name);
  ConfigValue root = builder.take();
  if (root.kind == ConfigValue::Kind::null) {
    root.kind = ConfigValue::Kind::map;
    root.place = {file_name, 1, 1};
  }
  return root;
}

ConfigValue read_config_file(const std::filesystem::path& file) {
  return parse_config_text(text_of(file), file.string());
}

}  // namespace cairn
