#include "framework/program/common/printable_stream.hpp"

#include <algorithm>

#include "maps/base/printable.hpp"

namespace cairn {
namespace {

constexpr std::string_view kPass = "\n\t";
constexpr std::size_t kMaxCharacterBytes = 4;

// How many bytes at the end are the beginning of a character.
std::size_t begun_bytes(std::string_view text) {
  for (std::size_t bytes = 1; bytes <= std::min(text.size(), kMaxCharacterBytes - 1); ++bytes) {
    const auto byte = static_cast<unsigned char>(text[text.size() - bytes]);
    if (byte < 0x80U) return 0;
    if (byte < 0xC0U) continue;
    const std::size_t needed = byte < 0xE0U ? 2 : byte < 0xF0U ? 3 : 4;
    return needed > bytes ? bytes : 0;
  }
  return 0;
}

}  // namespace

PrintableBuffer::~PrintableBuffer() {
  const std::string shown = printable(begun_, kPass);
  target_.sputn(shown.data(), static_cast<std::streamsize>(shown.size()));
}

PrintableBuffer::int_type PrintableBuffer::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  const char text = traits_type::to_char_type(c);
  return write({&text, 1}) ? c : traits_type::eof();
}

std::streamsize PrintableBuffer::xsputn(const char* text, std::streamsize size) {
  return write({text, static_cast<std::size_t>(size)}) ? size : 0;
}

int PrintableBuffer::sync() {
  return target_.pubsync();
}

bool PrintableBuffer::write(std::string_view text) {
  const std::lock_guard lock(mutex_);
  std::string joined;
  if (!begun_.empty()) {
    joined = begun_.append(text);
    text = joined;
    begun_.clear();
  }
  const std::size_t whole = text.size() - begun_bytes(text);
  begun_ = text.substr(whole);
  text = text.substr(0, whole);
  std::string shown;
  if (first_unprintable(text, kPass) != std::string_view::npos) text = shown = printable(text, kPass);
  const auto size = static_cast<std::streamsize>(text.size());
  return target_.sputn(text.data(), size) == size;
}

PrintableStream::PrintableStream(std::ostream& stream) : stream_(stream), buffer_(*stream.rdbuf()) {
  stream_.rdbuf(&buffer_);
}

PrintableStream::~PrintableStream() {
  stream_.rdbuf(&buffer_.target());
}

std::streambuf* terminal_of(std::ostream& stream) {
  const auto* const printable_buffer = dynamic_cast<const PrintableBuffer*>(stream.rdbuf());
  return printable_buffer != nullptr ? &printable_buffer->target() : stream.rdbuf();
}

}  // namespace cairn
