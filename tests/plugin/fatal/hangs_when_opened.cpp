// A module whose static initialiser never ends.
#include <unistd.h>

#include "framework/contracts/module.hpp"

namespace {

int wait_for_ever() {
  for (;;) ::pause();
}

const int kWaited = wait_for_ever();

void register_module(cairn::Registrar&) {
  (void)kWaited;
}

}  // namespace

CAIRN_MODULE(register_module)
