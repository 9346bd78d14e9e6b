// Standard output and standard error without anything that steers a terminal, whoever wrote it: a file, another
// process, a module.
#pragma once

#include <mutex>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace cairn {

// Hands text on as printable() writes it; line feeds and tabs pass. JSON stays the same JSON.
class PrintableBuffer : public std::streambuf {
 public:
  explicit PrintableBuffer(std::streambuf& target) : target_(target) {}
  PrintableBuffer(const PrintableBuffer&) = delete;
  PrintableBuffer& operator=(const PrintableBuffer&) = delete;
  ~PrintableBuffer() override;

  [[nodiscard]] std::streambuf& target() const { return target_; }

 protected:
  int_type overflow(int_type c) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int sync() override;

 private:
  bool write(std::string_view text);

  std::streambuf& target_;
  std::mutex mutex_;   // modules print from threads of theirs
  std::string begun_;  // a UTF-8 character of which more may come
};

// While it lives, a stream writes by way of such a buffer.
class PrintableStream {
 public:
  explicit PrintableStream(std::ostream& stream);
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;
  ~PrintableStream();

 private:
  std::ostream& stream_;
  PrintableBuffer buffer_;
};

// Where the stream's text goes in the end: for who draws on a terminal and escapes foreign text itself.
[[nodiscard]] std::streambuf* terminal_of(std::ostream& stream);

}  // namespace cairn
