#include "plugins/json_log/json_log.hpp"
#include "tests/fuzz/fuzzed_log.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cairn::json_log::Config config;
  config.file = cairn::fuzz::file_of(data, size);
  config.on_bad_line = cairn::log_common::BadLine::skip;
  return cairn::fuzz::play([&] { return cairn::json_log::read_json_log(config); });
}
