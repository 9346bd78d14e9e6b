#include "plugins/muriel/beam_kernels.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plugins/muriel/beam_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// The same bits on every machine: single operations only, no estimates, no fused multiply-add (this file forbids
// contraction).
HWY_BEFORE_NAMESPACE();
namespace cairn::muriel {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kBlock_cells>;
using IntTag = hn::RebindToSigned<Tag>;
using WordTag = hn::RebindToUnsigned<Tag>;
using ShortTag = hn::Rebind<std::int16_t, Tag>;
using CountTag = hn::Rebind<std::uint16_t, Tag>;
using Floats = hn::Vec<Tag>;
using Ints = hn::Vec<IntTag>;
using Mask = hn::Mask<Tag>;

constexpr float kPerSqrtTwoPi = 0.39894228F;
constexpr float kMinAhead_m = 1e-6F;  // nearer to the sensor's own line than that, bearings mean nothing

HWY_INLINE Floats All(float x) {
  return hn::Set(Tag(), x);
}
HWY_INLINE bool Any(Mask mask) {
  return !hn::AllFalse(Tag(), mask);
}
HWY_INLINE Floats Bounded(Floats x, float low, float high) {
  return hn::Min(hn::Max(x, All(low)), All(high));
}
HWY_INLINE Ints LogOddsOf(const LogOdds* cells) {
  return hn::PromoteTo(IntTag(), hn::LoadU(ShortTag(), cells));
}

// atan(t) for |t| <= tan(20.5 deg), good to 1e-7; t2 = t * t.
HWY_INLINE Floats AtanNarrow(Floats t, Floats t2) {
  return t * ((All(0.999999734F) - All(0.333272128F) * t2) + (t2 * t2) * (All(0.197768828F) - All(0.116075268F) * t2));
}
// The same for |t| <= 1.
HWY_INLINE Floats AtanWide(Floats t, Floats t2) {
  const Floats t4 = t2 * t2;
  const Floats low = (All(0.999999882F) - All(0.333318127F) * t2) + t4 * (All(0.199669618F) - All(0.140032902F) * t2);
  const Floats high =
      (All(0.0986886546F) - All(0.0588297531F) * t2) + t4 * (All(0.0237805186F) - All(0.00455979199F) * t2);
  return t * (low + (t4 * t4) * high);
}

// e^x for -87 <= x <= 0, relative error 3e-6: a power of two times a short series.
HWY_INLINE Floats Exp(Floats x) {
  const IntTag di;
  const Floats scaled = x * All(1.44269504F);
  const Ints whole = hn::NearestInt(scaled);
  const Floats rest = (scaled - hn::ConvertTo(Tag(), whole)) * All(0.69314718F);
  const Floats series =
      (All(1.0F) + All(0.999960779F) * rest) +
      (rest * rest) * ((All(0.499993469F) + All(0.167946436F) * rest) + All(0.0418798061F) * (rest * rest));
  return series * hn::BitCast(Tag(), hn::ShiftLeft<23>(whole + hn::Set(di, 127)));
}

// 256 ln x for positive normal x, error 0.002: the series of atanh around a power of two.
HWY_INLINE Floats QuantaOfLn(Floats x) {
  const IntTag di;
  const Ints bits = hn::BitCast(di, x);
  // So that the rest lies within a factor sqrt(2) of 1.
  const Ints exponent = hn::ShiftRight<23>(bits - hn::Set(di, 0x3f3504f3));
  const Floats rest = hn::BitCast(Tag(), bits - hn::ShiftLeft<23>(exponent));
  const Floats s = (rest - All(1.0F)) / (rest + All(1.0F));
  return hn::ConvertTo(Tag(), exponent) * All(256.0F * 0.69314718F) +
         s * (All(256.0F * 1.99995481F) + All(256.0F * 0.678788687F) * (s * s));
}

// Abramowitz and Stegun 26.2.16 (error 1e-5); bell = e^(-z^2 / 2).
HWY_INLINE Floats NormalIntegral(Floats z, Floats bell) {
  const Floats t = All(1.0F) / (All(1.0F) + All(0.33267F) * hn::Abs(z));
  const Floats tail =
      (All(kPerSqrtTwoPi) * bell) * (t * (All(0.4361836F) + t * (All(0.937298F) * t - All(0.1201676F))));
  return hn::IfThenElse(z >= hn::Zero(Tag()), All(1.0F) - tail, tail);
}

// A list without branches: the next one overwrites an entry that does not count.
HWY_INLINE void ListIf(bool condition, int block, std::int32_t* list, int& length) {
  list[length] = block;
  length += condition ? 1 : 0;
}

enum class Width { ray, narrow, wide };

template <Width width>
HWY_INLINE ListLengths Place(const KernelReading& r, const Block* blocks, int count, const KernelCells& out) {
  const Tag d;
  const auto unbelieved = hn::Set(ShortTag(), static_cast<std::int16_t>(r.believed_from - 1));
  ListLengths lengths;
  for (int b = 0; b < count; ++b) {
    const Block& block = blocks[b];
    bool is_near = false;
    bool is_known = false;
    for (std::size_t lane = 0; lane < kBlock_cells; lane += hn::Lanes(d)) {
      const Floats lanes = hn::Iota(d, static_cast<float>(lane));
      const Floats lanes_m = lanes * All(r.cell_m);
      const Floats ahead = All(r.ahead_x * block.dx_m + r.ahead_y * block.dy_m) + All(r.ahead_x) * lanes_m;
      const Floats along = hn::Max(ahead, All(width == Width::ray ? 0.0F : kMinAhead_m));
      Floats range = along;
      Floats alpha = All(r.alpha_max);
      Floats off = hn::Zero(d);
      Mask inside = hn::And(lanes >= All(block.begin), lanes < All(block.end));
      if constexpr (width != Width::ray) {
        const Floats across = All(r.ahead_x * block.dy_m - r.ahead_y * block.dx_m) - All(r.ahead_y) * lanes_m;
        const Floats tangent = across / along;
        const Floats tangent2 = tangent * tangent;
        range = hn::Sqrt(along * along + across * across);
        off = (width == Width::narrow ? AtanNarrow(tangent, tangent2) : AtanWide(tangent, tangent2)) *
              All(r.per_half_beam);
        // On the axis behind the sensor the tangent is as small as before it.
        inside = hn::And(tangent2 <= All(r.widest_tangent2), ahead >= All(-kMinAhead_m));
        alpha = alpha - alpha * (off * off);
      }
      inside = hn::And(inside, range <= All(r.reach_m));
      alpha = hn::IfThenElseZero(inside, alpha * hn::Max(All(1.0F) - range * All(r.per_alpha_range), hn::Zero(d)));
      const std::size_t at = static_cast<std::size_t>(b) * kBlock_cells + lane;
      hn::StoreU(off, d, out.off + at);
      hn::StoreU(range, d, out.range_m + at);
      hn::StoreU(hn::Neg(alpha), d, out.evidence + at);
      is_near |= Any(hn::And(range > All(r.near_m), inside));
      is_known |= !hn::AllFalse(ShortTag(), hn::LoadU(ShortTag(), block.cells + lane) > unbelieved);
    }
    ListIf(is_near, b, out.near, lengths.near);
    ListIf(is_known, b, out.known, lengths.known);
  }
  return lengths;
}

ListLengths PlaceBlocks(const KernelReading& reading, const Block* blocks, int count, const KernelCells& cells) {
  const KernelReading r = reading;
  if (r.is_ray) return Place<Width::ray>(r, blocks, count, cells);
  if (r.widest_tangent2 <= kNarrowTangent2) return Place<Width::narrow>(r, blocks, count, cells);
  return Place<Width::wide>(r, blocks, count, cells);
}

HWY_INLINE float LargestOf(TargetList list, int length, int sector) {
  const Tag d;
  const IntTag di;
  Floats best = hn::Zero(d);
  for (std::size_t i = 0; i < static_cast<std::size_t>(length) * kBlock_cells; i += hn::Lanes(d)) {
    const auto is_there = hn::RebindMask(d, hn::LoadU(di, list.sector + i) == hn::Set(di, sector));
    best = hn::Max(best, hn::IfThenElseZero(is_there, hn::LoadU(d, list.value + i)));
  }
  return hn::GetLane(hn::MaxOfLanes(d, best));
}

void FindTargets(const KernelReading& reading, const Block* blocks, int known, const KernelCells& cells,
                 SectorTargets& best) {
  const Tag d;
  const IntTag di;
  const KernelReading r = reading;
  const KernelCells c = cells;
  const float density_scale = r.is_echo ? kPerSqrtTwoPi : 0.0F;
  const auto sectors = static_cast<float>(r.sectors);
  int blockers = 0;
  int sources = 0;
  for (int i = 0; i < known; ++i) {
    bool is_blocker = false;
    bool is_source = false;
    for (std::size_t lane = 0; lane < kBlock_cells; lane += hn::Lanes(d)) {
      const std::size_t at = static_cast<std::size_t>(c.known[i]) * kBlock_cells + lane;
      const Ints log_odds = LogOddsOf(blocks[c.known[i]].cells + lane);
      const Floats exponent = hn::Max(hn::ConvertTo(d, log_odds) * All(-1.0F / 256.0F), All(-80.0F));
      const Floats p = All(1.0F) / (All(1.0F) + Exp(exponent));
      const Mask is_believed = hn::RebindMask(d, log_odds > hn::Set(di, r.believed_from - 1));
      const Floats answer = hn::IfThenElseZero(is_believed, hn::Neg(p) * hn::LoadU(d, c.evidence + at));
      const Floats range = hn::LoadU(d, c.range_m + at);
      const Floats per_delta = All(1.0F) / (All(r.delta_m) + All(r.delta_per_m) * range);
      const Floats z = (All(r.range_m) - range) * per_delta;
      const Floats bounded = Bounded(z, -12.0F, 12.0F);
      const Floats density = answer * All(density_scale) * per_delta * Exp(All(-0.5F) * bounded * bounded);
      const Floats place = All(0.5F * sectors) * (hn::LoadU(d, c.off + at) + All(1.0F));
      const Ints sector = hn::ConvertTo(di, hn::Max(hn::Min(place, All(sectors - 0.5F)), hn::Zero(d)));
      const Floats blocking = hn::IfThenElseZero(z > All(3.0F), answer);
      const auto append = [&](Floats value, TargetList list, int length, bool& is_any) HWY_ATTR {
        const std::size_t place_in_list = static_cast<std::size_t>(length) * kBlock_cells + lane;
        hn::StoreU(value, d, list.value + place_in_list);
        hn::StoreU(sector, di, list.sector + place_in_list);
        is_any |= Any(value > hn::Zero(d));
      };
      append(blocking, c.blockers, blockers, is_blocker);
      append(density, c.sources, sources, is_source);
    }
    // Without branches, like ListIf().
    blockers += is_blocker ? 1 : 0;
    sources += is_source ? 1 : 0;
  }
  for (int k = 0; k < r.sectors; ++k) {
    best.blocking[k] = LargestOf(c.blockers, blockers, k);
    best.density_per_m[k] = LargestOf(c.sources, sources, k);
  }
}

void CompareBlocks(const KernelReading& reading, int near, const KernelCells& cells) {
  const Tag d;
  const KernelReading r = reading;
  const float hit_scale = r.is_echo ? kPerSqrtTwoPi * r.per_false_echo_m : 0.0F;
  for (int i = 0; i < near; ++i)
    for (std::size_t lane = 0; lane < kBlock_cells; lane += hn::Lanes(d)) {
      const std::size_t at = static_cast<std::size_t>(cells.near[i]) * kBlock_cells + lane;
      const Floats range = hn::LoadU(d, cells.range_m + at);
      const Floats per_delta = All(1.0F) / (All(r.delta_m) + All(r.delta_per_m) * range);
      const Floats z = Bounded((All(r.range_m) - range) * per_delta, -12.0F, 12.0F);
      const Floats bell = Exp(All(-0.5F) * z * z);
      const Floats hit = bell * per_delta * All(hit_scale);
      hn::StoreU(hn::LoadU(d, cells.evidence + at) * (NormalIntegral(z, bell) - hit), d, cells.evidence + at);
    }
}

HWY_INLINE Floats IncrementOf(const float* evidence, float weight) {
  return QuantaOfLn(All(1.0F) + All(weight) * hn::LoadU(Tag(), evidence));
}

bool SaysSomething(const float* evidence, const KernelScale& scale, int count) {
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(Tag())))
    if (Any(hn::Abs(IncrementOf(evidence + i, scale.weight)) >= All(0.5F))) return true;
  return false;
}

// Of each lane's count, 0 to 3.
HWY_INLINE Floats WeightOf(hn::Vec<WordTag> count, const float* weight_of_count) {
#if HWY_TARGET == HWY_SCALAR
  return hn::GatherIndex(Tag(), weight_of_count, hn::BitCast(IntTag(), count));
#else
  return hn::TableLookupLanes(hn::LoadDup128(Tag(), weight_of_count), hn::IndicesFromVec(Tag(), count));
#endif
}

// The change after the log's weight; counts it there.
template <bool two_planes>
HWY_INLINE Floats Logged(const KernelLog& log, Floats off, const float* weight_of_count, std::uint16_t* counts,
                         Floats change) {
  const Tag d;
  const IntTag di;
  const WordTag dw;
  const CountTag dc;
  // Unsigned, for cells that are not of the beam have any bearing.
  const auto bucket = hn::BitCast(dw, hn::ConvertTo(di, off * All(log.buckets_per_off) + All(log.buckets_to_axis)));
  const auto shifts = (bucket + bucket + hn::Set(dw, static_cast<std::uint32_t>(log.shift))) & hn::Set(dw, 31U);
  auto words = hn::PromoteTo(dw, hn::LoadU(dc, counts));
  if constexpr (two_planes)
    words = words | hn::ShiftLeft<16>(hn::PromoteTo(dw, hn::LoadU(dc, counts + log.plane_step)));
  const auto count = (words >> shifts) & hn::Set(dw, 3U);
  const Floats weight = WeightOf(count, weight_of_count);
  const auto is_taken = hn::RebindMask(dw, hn::And(hn::Abs(change) >= All(0.5F), weight > hn::Zero(d)));
  words = words + hn::IfThenElseZero(is_taken, hn::Set(dw, 1U) << shifts);
  const auto low = hn::BitCast(di, words & hn::Set(dw, 0xffffU));
  hn::StoreU(hn::DemoteTo(dc, low), dc, counts);
  if constexpr (two_planes)
    hn::StoreU(hn::DemoteTo(dc, hn::BitCast(di, hn::ShiftRight<16>(words))), dc, counts + log.plane_step);
  return change * weight;
}

template <bool has_log, bool two_planes>
HWY_INLINE void Apply(const KernelScale& by, const KernelLog& log, const Block* blocks, int count,
                      const KernelCells& cells) {
  const Tag d;
  const ShortTag ds;
  const auto highest = hn::Set(ds, static_cast<std::int16_t>(by.clamp));
  const auto lowest = hn::Neg(highest);
  for (int b = 0; b < count; ++b) {
    const Block& block = blocks[b];
    unsigned moved = 0;
    for (std::size_t lane = 0; lane < kBlock_cells; lane += hn::Lanes(d)) {
      const std::size_t at = static_cast<std::size_t>(b) * kBlock_cells + lane;
      Floats change = IncrementOf(cells.evidence + at, by.weight);
      if constexpr (has_log)
        change = Logged<two_planes>(log, hn::LoadU(d, cells.off + at), by.weight_of_count, block.log + lane, change);
      const auto before = hn::LoadU(ds, block.cells + lane);
      const auto sum = before + hn::DemoteTo(ds, hn::NearestInt(change));
      const auto after = hn::Max(hn::Min(sum, highest), lowest);
      hn::StoreU(after, ds, block.cells + lane);
      std::uint8_t bits[8];
      hn::StoreMaskBits(ds, after != before, bits);
      moved |= unsigned{bits[0]} << lane;
    }
    cells.moved[b] = static_cast<std::uint8_t>(moved);
  }
}

void ApplyBlocks(const KernelScale& scale, const KernelLog& log, const Block* blocks, int count,
                 const KernelCells& cells) {
  const KernelLog by = log;
  const KernelCells to = cells;
  if (!by.is_on) return Apply<false, false>(scale, by, blocks, count, to);
  if (by.plane_step == 0) return Apply<true, false>(scale, by, blocks, count, to);
  Apply<true, true>(scale, by, blocks, count, to);
}

}  // namespace HWY_NAMESPACE
}  // namespace cairn::muriel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::muriel {

HWY_EXPORT(PlaceBlocks);
HWY_EXPORT(FindTargets);
HWY_EXPORT(CompareBlocks);
HWY_EXPORT(SaysSomething);
HWY_EXPORT(ApplyBlocks);

ListLengths place_blocks(const KernelReading& reading, const Block* blocks, int count, const KernelCells& cells) {
  return HWY_DYNAMIC_DISPATCH(PlaceBlocks)(reading, blocks, count, cells);
}

void find_targets(const KernelReading& reading, const Block* blocks, int known, const KernelCells& cells,
                  SectorTargets& best) {
  HWY_DYNAMIC_DISPATCH(FindTargets)(reading, blocks, known, cells, best);
}

void compare_blocks(const KernelReading& reading, int near, const KernelCells& cells) {
  HWY_DYNAMIC_DISPATCH(CompareBlocks)(reading, near, cells);
}

bool says_something(const float* evidence, const KernelScale& scale, int count) {
  return HWY_DYNAMIC_DISPATCH(SaysSomething)(evidence, scale, count);
}

void apply_blocks(const KernelScale& scale, const KernelLog& log, const Block* blocks, int count,
                  const KernelCells& cells) {
  HWY_DYNAMIC_DISPATCH(ApplyBlocks)(scale, log, blocks, count, cells);
}

}  // namespace cairn::muriel
#endif
