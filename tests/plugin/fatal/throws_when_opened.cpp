// A module whose static initialiser throws.
#include <stdexcept>

#include "framework/contracts/module.hpp"

namespace {

int throw_error() {
  throw std::runtime_error("no \033[31mlicence\nfound");
}

const int kThrown = throw_error();

void register_module(cairn::Registrar&) {
  (void)kThrown;
}

}  // namespace

CAIRN_MODULE(register_module)
