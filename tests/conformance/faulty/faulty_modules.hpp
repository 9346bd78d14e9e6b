// Modules that break their contracts, each in one way, run through the suites: every one must fail the test that is for
// it. A program of its own, because its tests fail on purpose; faulty_modules_test.cpp judges it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "tests/conformance/subject.hpp"

namespace cairn::conformance {

inline const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

// A subject whose objects wrap those of a shipped module.
template <class Interface, class Wrapper>
Subject<Interface> wrapped(const std::string& name, const Subject<Interface>& inner) {
  return {name, [inner](const ContextOf<Interface>& context) -> std::shared_ptr<Interface> {
            return std::make_shared<Wrapper>(inner.make(context.seed));
          }};
}

}  // namespace cairn::conformance
