// A text format that goes by lines and blanks, token by token, with errors that say where a token is.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "maps/base/source_text.hpp"

namespace cairn::exchange {

// Refers to the source, which outlives it. `what` names a value in errors, `form` says how its line is written.
class LineTokens {
 public:
  explicit LineTokens(const SourceText& source) : source_(source) {}

  // To the next line; false after the last.
  bool next_line();
  // The text ends without a line end.
  [[nodiscard]] bool is_cut() const { return end_ == source_.text().size(); }

  // The next token, empty at the end of the line.
  std::string_view token();
  // What is left of the line, without blanks around it.
  std::string_view rest();
  // What is left of the text is skipped up to the next token, over line ends too; false when there is none.
  bool to_next_token();
  [[nodiscard]] std::size_t offset() const { return token_; }  // of the last token

  [[noreturn]] void fail(const std::string& sentence) const { fail_at(token_, sentence); }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& sentence) const;

  // The next token as a whole number of 0 to 2^53 - 1, as a coordinate, as a finite number. Throws ExchangeError.
  std::int64_t id(const std::string& what, const std::string& form);
  double coordinate_m(const std::string& what, const std::string& form);
  double number(const std::string& what, const std::string& form);

 private:
  void skip_blanks();
  std::string_view required(const std::string& what, const std::string& form);

  const SourceText& source_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
  std::size_t next_ = 0;
  std::size_t token_ = 0;
};

}  // namespace cairn::exchange
