#include "plugins/common/logs/log_text.hpp"

#include <zlib.h>

#include <algorithm>
#include <utility>

namespace cairn::log_common {
namespace {

constexpr unsigned kChunk = 1U << 17U;  // looked at the budget between two
constexpr std::size_t kLargestText = std::size_t{1} << 30U;

// A pipe would be waited for without end.
std::string why_no_log(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) return "there is no such log (recorded data is found through CAIRN_DATA)";
  if (std::filesystem::is_directory(status)) return "is a folder, not a log";
  return std::filesystem::is_regular_file(status) ? "" : "is not a regular file";
}

}  // namespace

struct LogText::Reader {
  gzFile file = nullptr;
  bool ended = false;

  explicit Reader(const std::filesystem::path& path) {
    if (const std::string why = why_no_log(path); !why.empty()) throw ConfigError({path.string(), 0, 0}, why);
    file = gzopen(path.c_str(), "rb");
    if (file == nullptr) throw ConfigError({path.string(), 0, 0}, "cannot read this log");
    gzbuffer(file, kChunk);
  }
  ~Reader() { gzclose(file); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  // Appends what comes next; says what is wrong with the data, if anything is.
  std::string append_to(std::string& text) {
    const std::size_t before = text.size();
    text.resize(before + kChunk);
    const int got = gzread(file, text.data() + before, kChunk);
    text.resize(before + static_cast<std::size_t>(std::max(0, got)));
    ended = got < static_cast<int>(kChunk);
    if (!ended) return {};
    int error = Z_OK;
    (void)gzerror(file, &error);
    if (error == Z_BUF_ERROR) return "the compressed log is cut off here";
    if (got < 0) return error == Z_ERRNO ? "the log cannot be read further" : "the compressed log is damaged here";
    return {};
  }
};

void check_budget(const Budget& budget, const std::string& file, int line) {
  if (budget.exhausted())
    throw ReadingEnded({file, line, line > 0 ? 1 : 0},
                       budget.cancelled() ? "reading this log was cancelled" : "reading this log took too long");
}

LogText::LogText(const std::filesystem::path& file, const Budget& budget)
    : name_(file.string()), budget_(budget), reader_(std::make_unique<Reader>(file)) {
  if (fill() && buffer_.starts_with("\xEF\xBB\xBF")) begin_ = 3;  // a byte order mark
}

LogText::~LogText() = default;

bool LogText::fill() {
  if (reader_->ended) return false;
  check_budget(budget_, name_, line_number_);
  damage_ = reader_->append_to(buffer_);
  return true;
}

std::string_view LogText::take(std::size_t end) {
  std::string_view line = std::string_view(buffer_).substr(begin_, end - begin_);
  begin_ = std::min(end + 1, buffer_.size());
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool LogText::next(std::string_view& line) {
  ++line_number_;
  std::size_t searched = begin_;
  bool too_long = false;
  while (true) {
    const std::size_t end = buffer_.find('\n', searched);
    too_long = too_long || std::min(end, buffer_.size()) - begin_ > kLongestLine;
    if (end != std::string::npos) {
      line = take(end);
      break;
    }
    buffer_.erase(0, too_long ? std::string::npos : begin_);
    begin_ = 0;
    searched = buffer_.size();
    if (fill()) continue;
    if (!damage_.empty()) {
      buffer_.clear();
      throw ConfigError({name_, line_number_, 1}, std::exchange(damage_, {}));
    }
    if (buffer_.empty() && !too_long) {
      --line_number_;
      return false;
    }
    line = take(buffer_.size());
    break;
  }
  if (too_long)
    throw ConfigError({name_, line_number_, 1},
                      "the line is longer than " + std::to_string(kLongestLine) + " characters");
  return true;
}

LogBytes::LogBytes(const std::filesystem::path& file, const Budget& budget)
    : name_(file.string()), budget_(budget), reader_(std::make_unique<LogText::Reader>(file)) {}

LogBytes::~LogBytes() = default;

std::size_t LogBytes::read(char* to, std::size_t count) {
  std::size_t given = 0;
  while (given < count) {
    if (begin_ == buffer_.size()) {
      if (reader_->ended || !damage_.empty()) break;
      check_budget(budget_, name_);
      buffer_.clear();
      begin_ = 0;
      damage_ = reader_->append_to(buffer_);
    }
    const std::size_t some = buffer_.copy(to + given, count - given, begin_);
    begin_ += some;
    given += some;
  }
  return given;
}

std::string text_of_file(const std::filesystem::path& file, const Budget& budget, std::string& damage) {
  LogText::Reader reader(file);
  std::string all;
  while (!reader.ended) {
    check_budget(budget, file.string());
    damage = reader.append_to(all);
    if (!damage.empty()) break;
    if (all.size() > kLargestText) throw ConfigError({file.string(), 0, 0}, "the log is larger than 1 GiB");
  }
  return all;
}

}  // namespace cairn::log_common
