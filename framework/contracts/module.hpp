// How a module makes itself known: one exported C function that fills a Registrar.
//
//   void register_module(cairn::Registrar& registrar) {
//     registrar.add<cairn::Localizer, MyConfig>("my_localizer", "one line for people",
//         [](const MyConfig& config, const cairn::LocalizerContext& context) {
//           return std::make_unique<MyLocalizer>(config, context.robot, context.T_map_start);
//         });
//   }
//   CAIRN_MODULE(register_module)
//
// The ABI stamp is a constant that the host compares before it calls anything of the module. It is made of all
// contracts, so this header is for the file with CAIRN_MODULE; algorithms include the contract that they implement.
#pragma once

#include "framework/contracts/abi_stamp.hpp"
#include "framework/contracts/registrar.hpp"

#if defined(CAIRN_STATIC_MODULE)
#define CAIRN_MODULE_CONCAT2(a, b) a##b
#define CAIRN_MODULE_CONCAT(a, b) CAIRN_MODULE_CONCAT2(a, b)
#define CAIRN_MODULE(function)                                                                              \
  extern "C" void CAIRN_MODULE_CONCAT(cairn_register_, CAIRN_STATIC_MODULE)(cairn::Registrar & registrar) { \
    function(registrar);                                                                                    \
  }
#else
#define CAIRN_MODULE(function)                                                                     \
  extern "C" {                                                                                     \
  extern __attribute__((visibility("default"))) const cairn::AbiStamp cairn_abi_stamp;             \
  const cairn::AbiStamp cairn_abi_stamp = cairn::this_abi_stamp();                                 \
  __attribute__((visibility("default"))) void cairn_register_module(cairn::Registrar& registrar) { \
    function(registrar);                                                                           \
  }                                                                                                \
  }
#endif
