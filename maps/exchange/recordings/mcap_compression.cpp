#include "maps/exchange/recordings/mcap_compression.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

#include "maps/exchange/recordings/mcap_fields.hpp"

namespace cairn::exchange {
namespace {

constexpr std::size_t kStep = std::size_t{1} << 20U;

// One decompressor: takes of `in`, writes at most `room` bytes to `out` and returns how many. Both are moved on.
struct Zstd {
  std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream{ZSTD_createDStream(), &ZSTD_freeDStream};

  std::size_t step(std::string_view& in, char* out, std::size_t room) const {
    ZSTD_inBuffer from{in.data(), in.size(), 0};
    ZSTD_outBuffer to{out, room, 0};
    const std::size_t result = ZSTD_decompressStream(stream.get(), &to, &from);
    if (ZSTD_isError(result) != 0) throw McapDamage(std::string("zstd: ") + ZSTD_getErrorName(result));
    in.remove_prefix(from.pos);
    return to.pos;
  }
};

struct Lz4 {
  std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context{made(), &LZ4F_freeDecompressionContext};

  static LZ4F_dctx* made() {
    LZ4F_dctx* context = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) throw std::bad_alloc();
    return context;
  }
  std::size_t step(std::string_view& in, char* out, std::size_t room) const {
    std::size_t taken = in.size();
    std::size_t written = room;
    const std::size_t result = LZ4F_decompress(context.get(), out, &written, in.data(), &taken, nullptr);
    if (LZ4F_isError(result) != 0) throw McapDamage(std::string("lz4: ") + LZ4F_getErrorName(result));
    in.remove_prefix(taken);
    return written;
  }
};

template <class Decompressor>
std::string unpacked_by(const Decompressor& decompressor, std::string_view packed, std::uint64_t size,
                        const std::function<void()>& look) {
  std::string bytes;
  std::size_t filled = 0;
  while (true) {
    // One byte more than there should be shows that there is more.
    if (bytes.size() < filled + kStep) bytes.resize(std::min<std::uint64_t>(size + 1, std::max(2 * filled, kStep)));
    const std::size_t before = packed.size();
    const std::size_t written =
        decompressor.step(packed, bytes.data() + filled, std::min(kStep, bytes.size() - filled));
    filled += written;
    if (look) look();
    if (filled > size) break;
    if (written == 0 && packed.size() == before) break;
  }
  if (filled != size)
    throw McapDamage("the chunk says that it unpacks to " + std::to_string(size) + " bytes, but " +
                     (filled > size ? std::string("there are more") : "there are " + std::to_string(filled)));
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::string unpacked(std::string_view compression, std::string_view packed, std::uint64_t size,
                     const std::function<void()>& look) {
  if (compression == "zstd") return unpacked_by(Zstd{}, packed, size, look);
  if (compression == "lz4") return unpacked_by(Lz4{}, packed, size, look);
  if (!compression.empty())
    throw McapDamage("a chunk compressed by \"" + std::string(compression.substr(0, 32)) +
                     "\"; none, lz4 and zstd can be read");
  if (packed.size() != size)
    throw McapDamage("the chunk says that it holds " + std::to_string(size) + " bytes, but there are " +
                     std::to_string(packed.size()));
  return std::string(packed);
}

}  // namespace cairn::exchange
