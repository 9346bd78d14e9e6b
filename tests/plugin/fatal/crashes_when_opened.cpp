// A module that crashes in a static initialiser.
#include <csignal>

#include "framework/contracts/module.hpp"

namespace {

// Whatever the program, or a sanitizer, does about it.
int crash() {
  std::signal(SIGSEGV, SIG_DFL);
  return std::raise(SIGSEGV);
}

const int kCrashed = crash();

void register_module(cairn::Registrar&) {
  (void)kCrashed;
}

}  // namespace

CAIRN_MODULE(register_module)
