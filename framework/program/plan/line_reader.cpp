#include "framework/program/plan/line_reader.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "framework/config/config_value.hpp"

namespace cairn {

LineReader::LineReader(const std::string& file) : file_(file) {
  std::error_code error;
  if (file == "-") {
    input_ = STDIN_FILENO;
  } else if (!std::filesystem::exists(file, error)) {
    throw ConfigError({file, 0, 0}, "no such file");
  } else if (std::filesystem::is_directory(file, error)) {
    throw ConfigError({file, 0, 0}, "is a folder");
  } else {
    input_ = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (input_ < 0) throw ConfigError({file, 0, 0}, std::string("cannot be read: ") + std::strerror(errno));
  }
  if (pipe2(wake_, O_CLOEXEC | O_NONBLOCK) != 0) {
    const int why = errno;
    if (input_ != STDIN_FILENO) close(input_);
    throw ConfigError({file, 0, 0}, std::string("cannot be read: ") + std::strerror(why));
  }
}

LineReader::~LineReader() {
  if (input_ != STDIN_FILENO) close(input_);
  for (const int end : wake_) close(end);
}

void LineReader::stop() {
  // A full pipe has woken it already.
  if (write(wake_[1], "", 1) < 0) return;
}

// False at the end, or when stopped.
bool LineReader::read_more() {
  std::array<pollfd, 2> ends{{{input_, POLLIN, 0}, {wake_[0], POLLIN, 0}}};
  if (poll(ends.data(), ends.size(), -1) < 0) return errno == EINTR;
  if (ends[1].revents != 0) {
    read_.clear();
    begin_ = 0;
    return false;
  }
  if (begin_ > 0) read_.erase(0, begin_);
  begin_ = 0;
  std::array<char, 65536> block;
  const ssize_t count = read(input_, block.data(), block.size());
  if (count < 0 && errno != EINTR && errno != EAGAIN)
    throw ConfigError({file_, number_ + 1, 1}, std::string("cannot be read on: ") + std::strerror(errno));
  if (count > 0) read_.append(block.data(), static_cast<std::size_t>(count));
  return count != 0;
}

bool LineReader::next(std::string& line) {
  std::size_t searched = begin_;
  for (;;) {
    const std::size_t end = read_.find('\n', searched);
    if (end != std::string::npos || at_end_) {
      if (begin_ >= read_.size()) return false;
      line = read_.substr(begin_, end == std::string::npos ? std::string::npos : end - begin_);
      begin_ = end == std::string::npos ? read_.size() : end + 1;
      ++number_;
      return true;
    }
    const std::size_t length = read_.size() - begin_;
    if (length > kMaxBytes) throw ConfigError({file_, number_ + 1, 1}, "a line of more than 1 MiB");
    at_end_ = !read_more();
    searched = begin_ + std::min(length, read_.size() - begin_);
  }
}

}  // namespace cairn
