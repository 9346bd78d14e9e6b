// Starting the `cairn` program from a test.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cairn::testing_program {

struct Finished {
  int exit_status = -1;
  std::string out;
  std::string err;
};

// Runs build/.../bin/cairn with these arguments, standard input empty.
Finished run_cairn(const std::vector<std::string>& arguments);

// What a run meets.
struct Circumstances {
  std::optional<std::uint64_t> max_file_bytes{};  // no file can grow beyond: like a disk that is full
  bool as_nobody = false;                         // when the tests run as root, whom no folder is read-only to
};
Finished run_cairn(const std::vector<std::string>& arguments, const Circumstances& circumstances);

// Ended with SIGKILL, unless it has ended before.
struct Killed {
  struct Line {
    double at_s = 0.0;  // wall clock since the start
    std::string text;
  };
  std::vector<Line> lines;  // of standard output
  double killed_s = 0.0;    // wall clock since the start
  bool has_ended = false;
};
// The delay runs from the first line that holds this text.
Killed kill_cairn(const std::vector<std::string>& arguments, const std::string& from, double delay_s);

// The same, and sends SIGINT after the first line has come out.
Finished interrupt_cairn(const std::vector<std::string>& arguments);

// What a running mission's control socket says to this; "not connected" when there is none.
std::string answer_to(const std::filesystem::path& socket_file, const std::string& text);

// A program that is talked to line by line.
class Conversation {
 public:
  explicit Conversation(const std::vector<std::string>& arguments);
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;
  ~Conversation();

  void say(const std::string& line) const;
  // Its next line on standard output, however long that takes; empty when it has ended.
  [[nodiscard]] std::string hear() const;
  void send(int signal) const;
  // Its exit status, once it has ended by itself; its standard input stays open as long.
  [[nodiscard]] int exit_status();

 private:
  int input_ = -1;
  int output_ = -1;
  int child_ = -1;
};

// A fresh, empty folder for one test.
std::filesystem::path fresh_folder(const std::string& name);
std::string text_of_file(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);
std::string source_folder();

}  // namespace cairn::testing_program
