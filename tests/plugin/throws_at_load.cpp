// A module that throws while it registers.
#include <stdexcept>

#include "framework/contracts/module.hpp"

static void register_module(cairn::Registrar&) {
  throw std::runtime_error("no licence found");
}
CAIRN_MODULE(register_module)
