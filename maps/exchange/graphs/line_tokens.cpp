#include "maps/exchange/graphs/line_tokens.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/graphs/file_ids.hpp"

namespace cairn::exchange {

bool LineTokens::next_line() {
  if (next_ >= source_.text().size()) return false;
  at_ = next_;
  end_ = std::min(source_.text().find('\n', at_), source_.text().size());
  next_ = end_ + 1;
  return true;
}

std::string_view LineTokens::token() {
  skip_blanks();
  token_ = at_;
  at_ = std::min(source_.text().find_first_of(" \t\r\n", at_), end_);
  return source_.text().substr(token_, at_ - token_);
}

std::string_view LineTokens::rest() {
  skip_blanks();
  token_ = at_;
  const std::string_view left = source_.text().substr(at_, end_ - at_);
  const std::size_t last = left.find_last_not_of(kLineBlanks);
  return left.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

bool LineTokens::to_next_token() {
  skip_blanks();
  while (at_ == end_) {
    if (!next_line()) return false;
    skip_blanks();
  }
  return true;
}

void LineTokens::fail_at(std::size_t offset, const std::string& sentence) const {
  if (is_cut()) source_.fail_cut(offset, sentence);
  source_.fail(offset, sentence);
}

std::int64_t LineTokens::id(const std::string& what, const std::string& form) {
  const std::string_view text = required(what, form);
  const auto id = number_from<std::uint64_t>(text);
  if (!id || *id > kMaxFileId)
    fail(what + " " + in_quotes(text) + " is not a whole number of 0 to " + std::to_string(kMaxFileId));
  return static_cast<std::int64_t>(*id);
}

double LineTokens::coordinate_m(const std::string& what, const std::string& form) {
  const double value_m = number(what, form);
  source_.check_coordinate(token_, value_m);
  return value_m;
}

double LineTokens::number(const std::string& what, const std::string& form) {
  const std::string_view text = required(what, form);
  double value = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || rest != text.data() + text.size())
    fail(what + " " + in_quotes(text) + " is not a number");
  if (error != std::errc{} || !std::isfinite(value))
    fail(what + " " + in_quotes(text) + " is not allowed: it must be a finite number");
  return value;
}

void LineTokens::skip_blanks() {
  at_ = std::min(source_.text().find_first_not_of(kLineBlanks, at_), end_);
}

std::string_view LineTokens::required(const std::string& what, const std::string& form) {
  const std::string_view text = token();
  if (text.empty()) fail(what + " is missing: " + form);
  return text;
}

}  // namespace cairn::exchange
