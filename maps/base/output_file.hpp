// Files that the program writes.
//
// A file is written beside its target and renamed over it: whoever opens the target at any moment, also after a kill or
// a power cut, finds the whole old or the whole new content. Symbolic links are not followed, neither at the target nor
// at the file beside it: a link is replaced by the file. Short writes and what the disk reports late (at fsync, at
// close) are errors.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace cairn {

// What is wrong, without the file: "cannot be written: No space left on device".
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Links { replace, follow };

struct WritingRules {
  Links links = Links::replace;  // follow: a link at the target leads to the file that is replaced
  bool sync = true;              // the content is on the disk before it takes the old one's place
};

// A file that replaces another keeps its mode. Writers of the same file take turns. A device, a named pipe and what a
// shell hands over (/dev/stdout, /dev/fd/N) are written into. Throws OutputError, and the old content stays.
void replace_file(const std::filesystem::path& file, std::string_view bytes, const WritingRules& rules = {});

// The same; throws std::runtime_error, "FILE: cannot be written: REASON".
void write_file(const std::filesystem::path& file, std::string_view bytes);

// Two files of one folder change their names, both at once; modes stay with the names. False where the file system
// cannot: then nothing has changed.
[[nodiscard]] bool exchange_files(const std::filesystem::path& file, const std::filesystem::path& other);

// Adds to the end of a file, which is made when it is not there. Throws OutputError for what is not a plain file.
void append_to_file(const std::filesystem::path& file, std::string_view bytes);

// A file that grows while the program runs: in place of the old one at once, so that a program that is killed leaves
// what it has written so far. Throws OutputError.
class GrowingFile {
 public:
  explicit GrowingFile(const std::filesystem::path& file);
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;
  ~GrowingFile();

  // Small pieces wait until there are enough of them, or for flush().
  void append(std::string_view bytes);
  // The file holds what was appended, also when the program is killed.
  void flush();
  // Everything is on the disk.
  void close();

 private:
  int fd_ = -1;
  std::string waiting_;  // not yet written
};

}  // namespace cairn
