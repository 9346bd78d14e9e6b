// A module that ends the program while it registers.
#include <cstdlib>

#include "framework/contracts/module.hpp"

static void register_module(cairn::Registrar&) {
  std::exit(3);
}
CAIRN_MODULE(register_module)
