// A module that aborts while it registers.
#include <cstdlib>

#include "framework/contracts/module.hpp"

static void register_module(cairn::Registrar&) {
  std::abort();
}
CAIRN_MODULE(register_module)
