#include "framework/files/fault_rates.hpp"

namespace cairn {

void FaultRates::describe(Fields<FaultRates>& fields) {
  using C = FaultRates;
  constexpr Range kRate{0.0, 3600.0};
  fields.number("dead", &C::dead, kRate, "1/h", "one transducer without echo");
  fields.number("stuck", &C::stuck, kRate, "1/h", "one transducer at its last reading");
  fields.number("slip", &C::slip, kRate, "1/h", "left, right or both wheels, by a share from 0.1 to 0.9");
  fields.number("compass_jump", &C::compass_jump, kRate, "1/h", "by up to 90 deg either way");
  fields.number("silent", &C::silent, kRate, "1/h", "no ranges");
  fields.number("kidnap", &C::kidnap, kRate, "1/h", "to a free place of the world, turned anyhow");
  fields.number("deaf", &C::deaf, kRate, "1/h",
                "the whole ring without echo, its left half, its right half, or each one by half a chance");
}

}  // namespace cairn
