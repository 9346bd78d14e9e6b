#include "plugins/player_log/player_log.hpp"
#include "tests/fuzz/fuzzed_log.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const cairn::RobotModel robot;
  cairn::player_log::Config config;
  config.file = cairn::fuzz::file_of(data, size);
  config.on_bad_line = cairn::log_common::BadLine::skip;
  return cairn::fuzz::play([&] { return cairn::player_log::read_player_log(config, robot); });
}
