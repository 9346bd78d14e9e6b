#include "maps/exchange/grids/moving_ai_map.hpp"

#include <algorithm>

#include "maps/base/source_text.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

using exchange::kLineBlanks;
using exchange::SourceText;

constexpr std::string_view kFree = ".GS";
constexpr std::string_view kBlocked = "@OTW";

// A line without its end and the blanks before that.
struct Line {
  std::string_view text;
  std::size_t offset = 0;
};

class MapLines {
 public:
  explicit MapLines(const SourceText& source) : source_(source) {}

  [[nodiscard]] bool at_end() const { return next_ >= source_.text().size(); }
  Line next() {
    const std::size_t begin = next_;
    const std::size_t end = std::min(source_.text().find('\n', begin), source_.text().size());
    next_ = end + 1;
    std::string_view line = source_.text().substr(begin, end - begin);
    line = line.substr(0, line.find_last_not_of(kLineBlanks) + 1);
    return {line, begin};
  }

 private:
  const SourceText& source_;
  std::size_t next_ = 0;
};

// The character at x, all its bytes.
std::string_view character_at(std::string_view text, std::size_t x) {
  std::size_t end = x + 1;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
  return text.substr(x, end - x);
}

// The word behind the key, with its offset in the text.
Line value_of(const SourceText& source, const Line& line, std::size_t key_length) {
  const std::size_t begin = std::min(line.text.find_first_not_of(kLineBlanks, key_length), line.text.size());
  const std::size_t end = std::min(line.text.find_first_of(kLineBlanks, begin), line.text.size());
  if (begin == end) source.fail(line.offset + begin, in_quotes(line.text.substr(0, key_length)) + " needs a value");
  const std::size_t more = std::min(line.text.find_first_not_of(kLineBlanks, end), line.text.size());
  if (more < line.text.size()) source.fail(line.offset + more, in_quotes(line.text.substr(more)) + " is too much");
  return {line.text.substr(begin, end - begin), line.offset + begin};
}

int side_of(const SourceText& source, const Line& value, std::string_view key) {
  constexpr int kMax = OccupancyGrid::kLargestCellIndex;
  const auto side = number_from<int>(value.text);
  if (!side || *side < 1 || *side > kMax)
    source.fail(value.offset, std::string(key) + " " + in_quotes(value.text) + " is not a whole number of 1 to " +
                                  std::to_string(kMax));
  return *side;
}

struct Header {
  bool has_type = false;
  int height = 0;
  int width = 0;
};

void take(Header& header, const SourceText& source, const Line& line) {
  const std::string_view key = line.text.substr(0, line.text.find_first_of(kLineBlanks));
  const auto fail_twice = [&] { source.fail(line.offset, in_quotes(key) + " stands here twice"); };
  if (key == "type") {
    if (header.has_type) fail_twice();
    header.has_type = true;
    const Line value = value_of(source, line, key.size());
    if (value.text != "octile")
      source.fail(value.offset, "the type " + in_quotes(value.text) + " is not known" +
                                    did_you_mean(value.text, {"octile"}) + ": octile is the one that is read");
  } else if (key == "height" || key == "width") {
    int& side = key == "height" ? header.height : header.width;
    if (side != 0) fail_twice();
    side = side_of(source, value_of(source, line, key.size()), key);
  } else {
    source.fail(line.offset, "unknown word " + in_quotes(key) + did_you_mean(key, {"type", "height", "width", "map"}) +
                                 ": before the rows stand type, height, width and map");
  }
}

Header header_of(const SourceText& source, MapLines& lines) {
  Header header;
  while (!lines.at_end()) {
    const Line line = lines.next();
    if (line.text != "map") {
      take(header, source, line);
      continue;
    }
    for (const auto& [key, is_there] : {std::pair{"type", header.has_type}, std::pair{"height", header.height > 0},
                                        std::pair{"width", header.width > 0}})
      if (!is_there) source.fail(line.offset, std::string("no ") + key + " stands before the map");
    if (std::int64_t{header.width} * header.height > OccupancyGrid::kMaxCells)
      source.fail(line.offset, std::to_string(header.width) + " x " + std::to_string(header.height) +
                                   " cells are too many, at most " + std::to_string(OccupancyGrid::kMaxCells) +
                                   " are possible");
    return header;
  }
  source.fail_cut(source.text().size(), "there is no line \"map\", behind which the rows stand");
}

void take_row(const SourceText& source, const Line& line, const Header& header, int y, OccupancyGrid& grid) {
  const auto clamp = static_cast<LogOdds>(grid.clamp_quanta());
  const auto width = static_cast<std::size_t>(header.width);
  const std::size_t count = std::min(line.text.size(), width);
  for (std::size_t x = 0; x < count; ++x) {
    const char c = line.text[x];
    const bool is_free = kFree.find(c) != std::string_view::npos;
    if (!is_free && kBlocked.find(c) == std::string_view::npos)
      source.fail(line.offset + x,
                  "unknown cell " + in_quotes(character_at(line.text, x)) + ": free are . G S, blocked are @ O T W");
    grid.set_log_odds({static_cast<int>(x), y}, is_free ? static_cast<LogOdds>(-clamp) : clamp);
  }
  if (line.text.size() != width)
    source.fail(line.offset + count,
                "the row has " + counted(line.text.size(), "cell") + ", width says " + std::to_string(header.width));
}

}  // namespace

ImportedGrid parse_moving_ai_map(std::string_view text, const std::string& file_name, double cell_m) {
  const SourceText source(text, file_name);
  MapLines lines(source);
  const Header header = header_of(source, lines);
  ImportedGrid imported{OccupancyGrid(cell_m), {}};
  for (int row = 0; row < header.height; ++row) {
    if (lines.at_end())
      source.fail_cut(source.text().size(), "the map has " + counted(static_cast<std::size_t>(row), "row") +
                                                ", height says " + std::to_string(header.height));
    take_row(source, lines.next(), header, header.height - 1 - row, imported.grid);
  }
  while (!lines.at_end()) {
    const Line line = lines.next();
    if (!line.text.empty())
      source.fail(line.offset, "the map has more rows than the " + std::to_string(header.height) + " that height says");
  }
  return imported;
}

}  // namespace cairn
