#include "plugins/carmen_log/carmen_log.hpp"
#include "tests/fuzz/fuzzed_log.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cairn::carmen_log::Config config;
  config.file = cairn::fuzz::file_of(data, size);
  config.on_bad_line = cairn::log_common::BadLine::skip;
  return cairn::fuzz::play([&] { return cairn::carmen_log::read_carmen_log(config); });
}
