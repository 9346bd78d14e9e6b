// The packed records of a chunk of an MCAP file.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace cairn::exchange {

// compression: "", "lz4" or "zstd". size: what the chunk says that it unpacks to. Never takes more memory than that and
// 1 MiB, nor that before the data is there. look: called once a MiB at least where there is something to unpack; what
// it throws passes through. Throws McapDamage for another compression, damaged data and another size.
[[nodiscard]] std::string unpacked(std::string_view compression, std::string_view packed, std::uint64_t size,
                                   const std::function<void()>& look = {});

}  // namespace cairn::exchange
