// A module that works until the program ends.
#include <csignal>

#include "framework/contracts/module.hpp"

namespace {

// Whatever the program, or a sanitizer, does about it.
int crash() {
  std::signal(SIGSEGV, SIG_DFL);
  return std::raise(SIGSEGV);
}

struct CrashingEnd {
  ~CrashingEnd() { (void)crash(); }
};

const CrashingEnd kEnd;

void register_module(cairn::Registrar&) {
  (void)kEnd;
}

}  // namespace

CAIRN_MODULE(register_module)
