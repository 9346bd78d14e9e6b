#include "tests/scenario/program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <limits>
#include <list>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace cairn::testing_program {
namespace {

// Removed when the test program ends, unless a test has failed: then they may show why.
class RemovedFolders {
 public:
  RemovedFolders() = default;
  RemovedFolders(const RemovedFolders&) = delete;
  RemovedFolders& operator=(const RemovedFolders&) = delete;
  ~RemovedFolders() {
    std::error_code ignored;
    if (getpid() != owner_ || testing::UnitTest::GetInstance()->Failed()) return;
    for (const auto& folder : folders_) std::filesystem::remove_all(folder, ignored);
  }

  const std::filesystem::path& add(const std::filesystem::path& folder) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folders_.emplace_back(folder);
  }

 private:
  const pid_t owner_ = getpid();
  std::list<std::filesystem::path> folders_;
};

struct Pipe {
  int read_end = -1;
  int write_end = -1;
  Pipe() {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    read_end = ends[0];
    write_end = ends[1];
  }
};

[[noreturn]] void execute_cairn(const std::vector<std::string>& arguments) {
  const std::string program = std::string(CAIRN_BINARY_DIR) + "/bin/cairn";
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

[[noreturn]] void become_cairn(const std::vector<std::string>& arguments, const Pipe& out, const Pipe& err) {
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(out.write_end, STDOUT_FILENO);
  dup2(err.write_end, STDERR_FILENO);
  for (const int end : {out.read_end, out.write_end, err.read_end, err.write_end}) close(end);
  execute_cairn(arguments);
}

// Reads both ends until they close; calls on_output once, when the first bytes of standard output came.
template <class OnOutput>
void drain(const Pipe& out, const Pipe& err, Finished& finished, OnOutput on_output) {
  pollfd ends[2] = {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}};
  std::string* texts[2] = {&finished.out, &finished.err};
  bool reported = false;
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    poll(ends, 2, -1);
    for (int i = 0; i < 2; ++i) {
      if (ends[i].fd < 0 || ends[i].revents == 0) continue;
      char buffer[4096];
      const ssize_t count = read(ends[i].fd, buffer, sizeof buffer);
      if (count > 0)
        texts[i]->append(buffer, static_cast<std::size_t>(count));
      else {
        close(ends[i].fd);
        ends[i].fd = -1;
      }
      if (i == 0 && count > 0 && !reported) {
        reported = true;
        on_output();
      }
    }
  }
}

void meet(const Circumstances& circumstances) {
  if (circumstances.max_file_bytes) {
    const rlimit limit{*circumstances.max_file_bytes, *circumstances.max_file_bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  constexpr uid_t kNobody = 65534;
  if (circumstances.as_nobody && geteuid() == 0 && setuid(kNobody) != 0) _exit(126);
}

Finished start(const std::vector<std::string>& arguments, bool interrupt, const Circumstances& circumstances = {}) {
  const Pipe out;
  const Pipe err;
  const pid_t child = fork();
  if (child == 0) {
    meet(circumstances);
    become_cairn(arguments, out, err);
  }
  close(out.write_end);
  close(err.write_end);
  Finished finished;
  drain(out, err, finished, [&] {
    if (interrupt) kill(child, SIGINT);
  });
  int status = 0;
  waitpid(child, &status, 0);
  finished.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return finished;
}

}  // namespace

Finished run_cairn(const std::vector<std::string>& arguments) {
  return start(arguments, false);
}
Finished run_cairn(const std::vector<std::string>& arguments, const Circumstances& circumstances) {
  return start(arguments, false, circumstances);
}

std::string answer_to(const std::filesystem::path& socket_file, const std::string& text) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  socket_file.string().copy(name.sun_path, sizeof name.sun_path - 1);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0) {
    ::close(socket);
    return "not connected";
  }
  (void)::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
  std::string answer;
  char c = 0;
  while (::recv(socket, &c, 1, 0) == 1 && c != '\n') answer += c;
  ::close(socket);
  return answer;
}

Killed kill_cairn(const std::vector<std::string>& arguments, const std::string& from, double delay_s) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const auto now_s = [begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const Pipe out;
  const pid_t child = fork();
  if (child == 0) become_cairn(arguments, out, Pipe());
  close(out.write_end);
  Killed killed;
  double kill_at_s = std::numeric_limits<double>::infinity();
  std::string line;
  while (now_s() < kill_at_s) {
    pollfd ready{out.read_end, POLLIN, 0};
    const double left_s = std::min(kill_at_s - now_s(), 1.0);
    if (poll(&ready, 1, std::max(0, static_cast<int>(1e3 * left_s))) <= 0) continue;
    char c = 0;
    if (read(out.read_end, &c, 1) != 1) {
      killed.has_ended = true;
      break;
    }
    if (c != '\n') {
      line += c;
      continue;
    }
    if (line.find(from) != std::string::npos) kill_at_s = std::min(kill_at_s, now_s() + delay_s);
    killed.lines.push_back({now_s(), std::exchange(line, {})});
  }
  killed.killed_s = now_s();
  kill(child, SIGKILL);
  close(out.read_end);
  waitpid(child, nullptr, 0);
  return killed;
}

Finished interrupt_cairn(const std::vector<std::string>& arguments) {
  return start(arguments, true);
}

Conversation::Conversation(const std::vector<std::string>& arguments) {
  const Pipe in;
  const Pipe out;
  child_ = fork();
  if (child_ == 0) {
    dup2(in.read_end, STDIN_FILENO);
    dup2(out.write_end, STDOUT_FILENO);
    for (const int end : {in.read_end, in.write_end, out.read_end, out.write_end}) close(end);
    execute_cairn(arguments);
  }
  close(in.read_end);
  close(out.write_end);
  input_ = in.write_end;
  output_ = out.read_end;
}

Conversation::~Conversation() {
  close(input_);
  close(output_);
  if (child_ > 0) waitpid(child_, nullptr, 0);
}

void Conversation::say(const std::string& line) const {
  const std::string text = line + "\n";
  ASSERT_EQ(write(input_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
}

std::string Conversation::hear() const {
  std::string line;
  for (char c = 0; read(output_, &c, 1) == 1 && c != '\n';) line += c;
  return line;
}

void Conversation::send(int signal) const {
  kill(child_, signal);
}

int Conversation::exit_status() {
  int status = 0;
  waitpid(child_, &status, 0);
  child_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::filesystem::path fresh_folder(const std::string& name) {
  static RemovedFolders removed;
  return removed.add(std::filesystem::path(testing::TempDir()) / ("cairn_" + name + "_" + std::to_string(getpid())));
}

std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::string source_folder() {
  return CAIRN_SOURCE_DIR;
}

}  // namespace cairn::testing_program
