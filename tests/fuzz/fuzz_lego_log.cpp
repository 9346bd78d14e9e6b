#include "plugins/lego_log/lego_log.hpp"
#include "tests/fuzz/fuzzed_log.hpp"

// Scans and motors from one file: each reader counts the other's lines as unknown.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cairn::lego_log::Config config;
  config.file = cairn::fuzz::file_of(data, size);
  config.motors = config.file;
  config.range_offset_m = 0.05;
  config.on_bad_line = cairn::log_common::BadLine::skip;
  return cairn::fuzz::play([&] { return cairn::lego_log::read_lego_log(config, 0.5); });
}
