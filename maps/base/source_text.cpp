#include "maps/base/source_text.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <boost/locale/utf.hpp>
#include <charconv>
#include <cmath>
#include <memory>

#include "maps/base/text.hpp"

namespace cairn::exchange {
namespace {

constexpr unsigned kBlock = 1U << 20U;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

SourceText::SourceText(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
  if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  const std::size_t bad = first_not_utf8(text_);
  if (bad != std::string_view::npos) fail(bad, "is not UTF-8 text");
}

int SourceText::line_of(std::size_t offset) const {
  return 1 + static_cast<int>(std::ranges::count(text_.substr(0, offset), '\n'));
}

void SourceText::fail(std::size_t offset, const std::string& sentence) const {
  offset = std::min(offset, text_.size());
  const std::size_t line_end = offset == 0 ? std::string_view::npos : text_.rfind('\n', offset - 1);
  const std::size_t line_begin = line_end == std::string_view::npos ? 0 : line_end + 1;
  throw ExchangeError(fmt::format("{}:{}:{}: {}", file_, line_of(offset), offset - line_begin + 1, sentence));
}

void SourceText::fail(const std::string& sentence) const {
  throw ExchangeError(file_ + ": " + sentence);
}

void SourceText::fail_cut(std::size_t offset, const std::string& sentence) const {
  fail(offset, sentence + "; the file ends here, it may have been cut");
}

void SourceText::check_coordinate(std::size_t offset, double coordinate_m) const {
  if (!(std::abs(coordinate_m) <= kMaxCoordinate_m))
    fail(offset, "the coordinate " + number_text(coordinate_m) + " is not allowed: it must be within " +
                     number_text(kMaxCoordinate_m) + " m");
}

bool may_never_open(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) return false;
  const std::string name = file.string();
  return !(name == "/dev/stdin" || name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/"));
}

std::string text_of_file(const std::filesystem::path& file, std::size_t max_bytes) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw ExchangeError(file.string() + ": no such file");
  if (std::filesystem::is_directory(status)) throw ExchangeError(file.string() + ": is a folder");
  if (may_never_open(file)) throw ExchangeError(file.string() + ": is no file: a pipe, a socket or a device");
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.c_str(), "rb"), gzclose);
  if (!in) throw ExchangeError(file.string() + ": cannot be read");
  std::string text;
  // Block by block: what is not a plain file has no size to ask for. What is not compressed is read as it is.
  while (true) {
    const std::size_t before = text.size();
    if (before > max_bytes)
      throw ExchangeError(fmt::format("{}: is larger than {} MiB", file.string(), max_bytes >> 20U));
    text.resize(before + kBlock);
    const int got = gzread(in.get(), text.data() + before, kBlock);
    text.resize(before + static_cast<std::size_t>(std::max(0, got)));
    if (got < static_cast<int>(kBlock)) break;
  }
  int error_number = Z_OK;
  (void)gzerror(in.get(), &error_number);
  if (error_number == Z_BUF_ERROR) throw ExchangeError(file.string() + ": the compressed file is cut off");
  if (error_number == Z_DATA_ERROR) throw ExchangeError(file.string() + ": the compressed file is damaged");
  if (error_number != Z_OK) throw ExchangeError(file.string() + ": cannot be read to its end");
  return text;
}

std::size_t first_not_utf8(std::string_view text) {
  namespace utf = boost::locale::utf;
  for (const char* at = text.begin(); at != text.end();) {
    const char* const character = at;
    const utf::code_point code = utf::utf_traits<char>::decode(at, text.end());
    if (code == utf::illegal || code == utf::incomplete) return static_cast<std::size_t>(character - text.begin());
  }
  return std::string_view::npos;
}

void append_number(std::string& text, double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof(buffer), value);
  text.append(buffer, end);
}

std::string number_text(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

void warn_of(std::size_t count, const std::string& noun, const std::string& sentence,
             std::vector<std::string>& warnings) {
  if (count > 0) warnings.push_back(counted(count, noun) + ": " + sentence);
}

}  // namespace cairn::exchange
