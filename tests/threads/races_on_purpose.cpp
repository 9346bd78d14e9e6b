// Two threads write the same number: ThreadSanitizer must report it, or its silence elsewhere is worth nothing.
#include <thread>

namespace {
int shared_number = 0;
}

int main() {
  std::thread other([] { shared_number = 1; });
  shared_number = 2;
  other.join();
  return shared_number == 0 ? 1 : 0;  // read, or compilers leave the writing out
}
