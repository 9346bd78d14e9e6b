// A module that is linked to a library which is gone when it is loaded.
#include "framework/contracts/module.hpp"

int answer_of_missing_library();

namespace {
void register_module(cairn::Registrar&) {
  (void)answer_of_missing_library();
}
}  // namespace

CAIRN_MODULE(register_module)
