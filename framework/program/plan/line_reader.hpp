// The lines of a file or of standard input, as they come.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace cairn {

class LineReader {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{1} << 20;  // of a line

  // "-" is standard input. Throws ConfigError when the file cannot be opened.
  explicit LineReader(const std::string& file);
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;
  ~LineReader();

  // The next line, without its end, as soon as it is there; false behind the last, and after stop(). Throws ConfigError
  // when the file cannot be read on, or the line is too long.
  bool next(std::string& line);
  [[nodiscard]] int number() const { return number_; }  // of that line, from 1
  // From any thread: a next() that waits for input returns false, and so do all later ones.
  void stop();

 private:
  bool read_more();

  std::string file_;
  int input_ = -1;
  int wake_[2] = {-1, -1};
  std::string read_;  // and not given out yet, from begin_ on
  std::size_t begin_ = 0;
  bool at_end_ = false;
  int number_ = 0;
};

}  // namespace cairn
