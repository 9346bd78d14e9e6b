#include "maps/exchange/graph_list.hpp"
#include "tests/fuzz/fuzzed_graph.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cairn::fuzz::exchange(data, size, cairn::parse_graph_list, cairn::graph_list_of);
}
