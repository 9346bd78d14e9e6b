#include <algorithm>

#include "maps/base/source_text.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/grids/grey_picture_readers.hpp"

namespace cairn::exchange {
namespace {

constexpr std::string_view kPgmBlanks = " \t\r\n\v\f";

// The numbers of a PGM's text; '#' begins a comment.
class Numbers {
 public:
  explicit Numbers(const PictureSource& source) : source_(source) {}

  [[nodiscard]] std::size_t offset() const { return at_; }  // behind the last number
  unsigned next(const char* what, unsigned least, unsigned most) {
    skip_blanks();
    const std::size_t end = std::min(source_.bytes.find_first_of(" \t\r\n\v\f#", at_), source_.bytes.size());
    const std::string_view text = source_.bytes.substr(at_, end - at_);
    if (text.empty()) fail(std::string(what) + " is missing; the file ends here, it may have been cut");
    const auto value = number_from<unsigned>(text);
    if (!value || *value < least || *value > most)
      fail(std::string(what) + " " + in_quotes(text) + " is not a whole number of " + std::to_string(least) + " to " +
           std::to_string(most));
    at_ = end;
    return *value;
  }
  [[noreturn]] void fail(const std::string& sentence) const {
    const std::string_view before = source_.bytes.substr(0, at_);
    const std::size_t line_begin = before.rfind('\n') + 1;  // 0 without one
    throw ExchangeError(source_.file + ":" + std::to_string(1 + std::ranges::count(before, '\n')) + ":" +
                        std::to_string(at_ - line_begin + 1) + ": " + sentence);
  }

 private:
  void skip_blanks() {
    for (;;) {
      at_ = std::min(source_.bytes.find_first_not_of(kPgmBlanks, at_), source_.bytes.size());
      if (at_ == source_.bytes.size() || source_.bytes[at_] != '#') return;
      at_ = std::min(source_.bytes.find('\n', at_), source_.bytes.size());
    }
  }

  const PictureSource& source_;
  std::size_t at_ = 2;  // behind the magic number
};

}  // namespace

GreyPicture read_pgm(const PictureSource& source) {
  Numbers numbers(source);
  constexpr unsigned kMaxSide = OccupancyGrid::kLargestCellIndex;
  const unsigned width = numbers.next("the width", 1, kMaxSide);
  const unsigned height = numbers.next("the height", 1, kMaxSide);
  GreyPicture picture = source.sized(width, height);
  const unsigned white = numbers.next("the value of white", 1, 65535);
  const std::size_t count = std::size_t{width} * height;
  const auto grey = [&](unsigned value) {
    return static_cast<std::uint8_t>((std::min(value, white) * 255U + white / 2) / white);
  };
  const bool is_text = source.bytes[1] == '2';
  const std::size_t bytes = white < 256 ? 1 : 2;
  const std::size_t begin = numbers.offset() + 1;  // one blank stands before the pixels
  const std::size_t left = source.bytes.size() > begin ? source.bytes.size() - begin : 0;
  // In text every pixel takes a digit and a blank, but for the last.
  if (left < (is_text ? 2 * count - 1 : bytes * count))
    source.fail("holds " + counted(left, "byte") + " of pixels, too few for " + std::to_string(width) + " x " +
                std::to_string(height) + "; it may have been cut");
  picture.grey.resize(count);
  if (is_text) {
    for (std::uint8_t& pixel : picture.grey) pixel = grey(numbers.next("a pixel", 0, white));
    return picture;
  }
  const auto byte = [&](std::size_t i) {
    return static_cast<unsigned>(static_cast<unsigned char>(source.bytes[begin + i]));
  };
  for (std::size_t i = 0; i < count; ++i)
    picture.grey[i] = grey(bytes == 1 ? byte(i) : byte(2 * i) << 8U | byte(2 * i + 1));
  return picture;
}

}  // namespace cairn::exchange
