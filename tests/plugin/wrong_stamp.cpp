// A module whose ABI stamp says that it was built by another compiler.
#include "framework/contracts/module.hpp"

namespace {
constexpr cairn::AbiStamp foreign_stamp() {
  cairn::AbiStamp stamp = cairn::this_abi_stamp();
  cairn::abi_detail::copy(stamp.compiler, "gcc 99.0");
  return stamp;
}
}  // namespace

extern "C" {
extern __attribute__((visibility("default"))) const cairn::AbiStamp cairn_abi_stamp;
const cairn::AbiStamp cairn_abi_stamp = foreign_stamp();
__attribute__((visibility("default"))) void cairn_register_module(cairn::Registrar&) {}
}
