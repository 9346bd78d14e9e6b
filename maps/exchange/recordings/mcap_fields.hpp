// The fields of one record of an MCAP file, one after the other.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace cairn::exchange {

// A record, or what is packed in it, is not what it should be.
class McapDamage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws McapDamage where a field reaches beyond its record.
class McapFields {
 public:
  explicit McapFields(std::string_view bytes) : bytes_(bytes) {}
  std::uint16_t u16() { return number<std::uint16_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::uint64_t u64() { return number<std::uint64_t>(); }
  std::uint8_t u8() { return number<std::uint8_t>(); }
  std::string_view text() { return take(u32()); }
  std::string_view take(std::uint64_t count) {
    if (count > bytes_.size() - at_) throw McapDamage("a field reaches beyond its record");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  [[nodiscard]] std::string_view rest() const { return bytes_.substr(at_); }
  [[nodiscard]] std::string_view before() const { return bytes_.substr(0, at_); }
  [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size(); }

 private:
  // Little-endian whatever the machine.
  template <class Unsigned>
  Unsigned number() {
    const std::string_view bytes = take(sizeof(Unsigned));
    Unsigned value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
      value = static_cast<Unsigned>(
          value | static_cast<Unsigned>(static_cast<Unsigned>(static_cast<unsigned char>(bytes[i])) << (8 * i)));
    return value;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace cairn::exchange
