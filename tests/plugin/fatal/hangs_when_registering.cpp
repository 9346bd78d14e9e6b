// A module that never ends to register, and starts a process that would outlive it.
#include <unistd.h>

#include "framework/contracts/module.hpp"

static void register_module(cairn::Registrar&) {
  (void)::fork();
  for (;;) ::pause();
}
CAIRN_MODULE(register_module)
