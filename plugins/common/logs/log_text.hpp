// A text file line by line, plain or gzip (its first bytes say which), in bounded memory. The budget is looked at
// before every 128 KiB of text, so that a small file that unpacks to gigabytes can be given up at any time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "framework/config/config_value.hpp"
#include "framework/contracts/budget.hpp"

namespace cairn::log_common {

// The budget of the reading is exhausted; no rule for bad lines applies to that.
class ReadingEnded : public ConfigError {
 public:
  using ConfigError::ConfigError;
};

class LogText {
 public:
  // Longer lines are no lines of any log we know.
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20U;

  // Throws ConfigError when the file cannot be read, ReadingEnded when the budget is exhausted.
  explicit LogText(const std::filesystem::path& file, const Budget& budget = {});
  ~LogText();
  LogText(const LogText&) = delete;
  LogText& operator=(const LogText&) = delete;

  // The next line without its end mark, valid until the next call; false at the end of the file.
  // Throws ConfigError for a line that is too long (the next call goes on behind it) and where the
  // gzip data is cut off or damaged (the half line there is dropped; the next call says end).
  // Throws ReadingEnded when the budget is exhausted.
  bool next(std::string_view& line);

  [[nodiscard]] int line_number() const { return line_number_; }  // of the latest line, from 1
  [[nodiscard]] const std::string& name() const { return name_; }

  struct Reader;

 private:
  bool fill();
  [[nodiscard]] std::string_view take(std::size_t end);

  std::string name_;
  Budget budget_;
  std::unique_ptr<Reader> reader_;
  std::string buffer_;
  std::size_t begin_ = 0;  // of what has not been given out
  int line_number_ = 0;
  std::string damage_;  // what is wrong with the compressed data, until it has been reported
};

// The whole of such a file, or what could be unpacked of it; then `damage` says what is wrong. Throws ConfigError when
// it cannot be read or is larger than 1 GiB, ReadingEnded when the budget is exhausted.
[[nodiscard]] std::string text_of_file(const std::filesystem::path& file, const Budget& budget, std::string& damage);

// The bytes of such a file, for logs that are no text.
class LogBytes {
 public:
  // Throws ConfigError when the file cannot be read.
  explicit LogBytes(const std::filesystem::path& file, const Budget& budget = {});
  ~LogBytes();
  LogBytes(const LogBytes&) = delete;
  LogBytes& operator=(const LogBytes&) = delete;

  // At most count bytes; fewer at the end and where compressed data is cut off or damaged. Throws ReadingEnded when the
  // budget is exhausted.
  std::size_t read(char* to, std::size_t count);
  // What is wrong with the compressed data, if anything is.
  [[nodiscard]] const std::string& damage() const { return damage_; }

 private:
  std::string name_;
  Budget budget_;
  std::unique_ptr<LogText::Reader> reader_;
  std::string buffer_;
  std::size_t begin_ = 0;  // of what has not been given out
  std::string damage_;
};

// Throws ReadingEnded at this line when the budget is exhausted.
void check_budget(const Budget& budget, const std::string& file, int line = 0);

}  // namespace cairn::log_common
