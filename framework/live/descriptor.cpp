#include "framework/live/descriptor.hpp"

#include <unistd.h>

namespace cairn {

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

}  // namespace cairn
