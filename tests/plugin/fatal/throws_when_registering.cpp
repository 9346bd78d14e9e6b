// A module that throws while it registers, with control characters in the message.
#include <stdexcept>

#include "framework/contracts/module.hpp"

static void register_module(cairn::Registrar&) {
  throw std::runtime_error("no \033[31mlicence\nfound");
}
CAIRN_MODULE(register_module)
