// A fuzzer of the one reader that it was built for (CAIRN_FUZZED).
#include "tests/fuzz/reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const cairn::fuzz::Reader& reader = cairn::fuzz::reader_called(CAIRN_FUZZED);
  reader.read({data, size});
  return 0;
}
