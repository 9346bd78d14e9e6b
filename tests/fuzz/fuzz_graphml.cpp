#include "maps/exchange/graphml.hpp"
#include "tests/fuzz/fuzzed_graph.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cairn::fuzz::exchange(data, size, cairn::parse_graphml, cairn::graphml_of);
}
