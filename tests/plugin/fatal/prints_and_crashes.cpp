// A module that prints control characters on both outputs, and then crashes while it registers.
#include <csignal>
#include <cstdio>

#include "framework/contracts/module.hpp"

// Whatever the program, or a sanitizer, does about it.
static int crash() {
  std::signal(SIGSEGV, SIG_DFL);
  return std::raise(SIGSEGV);
}

static void register_module(cairn::Registrar&) {
  std::fputs("\033[2Jout\n", stdout);
  std::fflush(stdout);
  std::fputs("err\r\a", stderr);
  (void)crash();
}
CAIRN_MODULE(register_module)
