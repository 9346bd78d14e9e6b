// A `cairn view` of its own process beside a run: the mission's process opens no port.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace cairn {

class Viewer {
 public:
  // Watches the run in that folder; control: may steer it. It prints its address, to standard error where standard
  // output is not for people, and ends with this process, however that ends. Throws std::runtime_error when it cannot
  // be started.
  Viewer(const std::filesystem::path& folder, bool control, bool to_standard_error);
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  ~Viewer();

 private:
  pid_t child_ = -1;
};

}  // namespace cairn
