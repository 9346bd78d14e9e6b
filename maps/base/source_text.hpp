// The text of an imported file, and errors that say where in it they are.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

// Bad input from outside: what() is "file:line:column: sentence" (columns count bytes from 1), or "file: sentence"
// where there is no place in the text.
class ExchangeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace exchange {

// Room for every grid reference on Earth; squares and sums of what is far beyond would be no numbers any more.
inline constexpr double kMaxCoordinate_m = 1e9;

inline constexpr std::string_view kLineBlanks = " \t\r";  // of a format that goes by lines

// Refers to the text, which outlives it.
class SourceText {
 public:
  // Leaves a byte order mark away. Throws ExchangeError at the first byte that is not UTF-8.
  SourceText(std::string_view text, std::string file);

  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] int line_of(std::size_t offset) const;  // from 1
  [[noreturn]] void fail(std::size_t offset, const std::string& sentence) const;
  [[noreturn]] void fail(const std::string& sentence) const;
  // As fail(), for what is wrong where the file ends.
  [[noreturn]] void fail_cut(std::size_t offset, const std::string& sentence) const;
  // Fails when a coordinate that stands there is beyond kMaxCoordinate_m.
  void check_coordinate(std::size_t offset, double coordinate_m) const;

 private:
  std::string_view text_;
  std::string file_;
};

// A named pipe, a socket or a device: opening or reading it may never return. What a shell hands over (/dev/stdin,
// /dev/fd/N) is none.
[[nodiscard]] bool may_never_open(const std::filesystem::path& file);

// All bytes of a file, unpacked where it is compressed by gzip (its first bytes say so). Throws ExchangeError: no such
// file, a folder, larger than that (unpacked), cut off, damaged, not readable to its end.
inline constexpr std::size_t kMaxFileBytes = std::size_t{4} << 30;
[[nodiscard]] std::string text_of_file(const std::filesystem::path& file, std::size_t max_bytes = kMaxFileBytes);

// The offset of the first byte that does not belong to a UTF-8 character, or npos.
[[nodiscard]] std::size_t first_not_utf8(std::string_view text);

// The shortest text that reads back as the same double.
void append_number(std::string& text, double value);
[[nodiscard]] std::string number_text(double value);

// "2 routes: SENTENCE" as one warning more, nothing when there is none.
void warn_of(std::size_t count, const std::string& noun, const std::string& sentence,
             std::vector<std::string>& warnings);

}  // namespace exchange
}  // namespace cairn
