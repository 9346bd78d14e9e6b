// The kernels (beam_kernels.hpp) for the instruction set of the file that includes this.
#pragma once

#include "plugins/muriel/beam_kernels.hpp"
#include "plugins/muriel/beam_vectors.hpp"

namespace cairn::muriel {
namespace {  // NOLINT

// A list without branches: the next one overwrites an entry that does not count.
CAIRN_INLINE void list_if(bool condition, int block, std::int32_t* list, int& length) {
  list[length] = block;
  length += condition ? 1 : 0;
}

enum class Width { ray, narrow, wide };

constexpr float kMinAhead_m = 1e-6F;  // nearer to the sensor's own line than that, bearings mean nothing

template <Width width>
CAIRN_INLINE ListLengths place(const KernelReading& r, const Block* blocks, int count, const KernelCells& out) {
  const Floats lanes_m = kLane * r.cell_m;
  const Floats ahead_of_lanes = r.ahead_x * lanes_m;
  const Floats across_of_lanes = r.ahead_y * lanes_m;
  const Floats alpha_max = all(r.alpha_max);
  const auto believed_from = static_cast<std::int16_t>(r.believed_from);
  ListLengths lengths;
  for (int b = 0; b < count; ++b) {
    const Block& block = blocks[b];
    const Floats ahead = all(r.ahead_x * block.dx_m + r.ahead_y * block.dy_m) + ahead_of_lanes;
    const Floats along = larger(ahead, all(width == Width::ray ? 0.0F : kMinAhead_m));
    Floats range = along;
    Floats alpha = alpha_max;
    Floats off{};
    Ints inside;
    if constexpr (width == Width::ray) {
      inside = (kLane >= block.begin) & (kLane < block.end);
    } else {
      const Floats across = all(r.ahead_x * block.dy_m - r.ahead_y * block.dx_m) - across_of_lanes;
      const Floats tangent = across / along;
      const Floats tangent2 = tangent * tangent;
      range = square_root(along * along + across * across);
      off = (width == Width::narrow ? atan_narrow(tangent, tangent2) : atan_wide(tangent, tangent2)) * r.per_half_beam;
      const Floats off2 = off * off;
      // On the axis behind the sensor the tangent is as small as before it.
      inside = (tangent2 <= r.widest_tangent2) & (ahead >= -kMinAhead_m);
      alpha -= alpha * off2;
    }
    inside &= range <= r.reach_m;
    alpha = where(inside, alpha * larger(1.0F - range * r.per_alpha_range, Floats{}));
    store(out.off + b * kBlock_cells, off);
    store(out.range_m + b * kBlock_cells, range);
    store(out.evidence + b * kBlock_cells, -alpha);
    list_if(any((range > r.near_m) & inside), b, out.near, lengths.near);
    list_if(any(load<Shorts>(block.cells) >= believed_from), b, out.known, lengths.known);
  }
  return lengths;
}

ListLengths place_blocks(const KernelReading& reading, const Block* blocks, int count, const KernelCells& cells) {
  const KernelReading r = reading;
  if (r.is_ray) return place<Width::ray>(r, blocks, count, cells);
  if (r.widest_tangent2 <= kNarrowTangent2) return place<Width::narrow>(r, blocks, count, cells);
  return place<Width::wide>(r, blocks, count, cells);
}

// Appends without branches, like list_if().
CAIRN_INLINE void append_if_any(const Floats& value, const Ints& sector, TargetList list, int& length) {
  store(list.value + length * kBlock_cells, value);
  store(list.sector + length * kBlock_cells, sector);
  length += any(value > 0.0F) ? 1 : 0;
}
CAIRN_INLINE float largest_of(TargetList list, int length, int sector) {
  Floats lanes{};
  for (int i = 0; i < length; ++i)
    lanes = larger(lanes, where(load<Ints>(list.sector + i * kBlock_cells) == sector,
                                load<Floats>(list.value + i * kBlock_cells)));
  float best = 0.0F;
  for (int lane = 0; lane < kBlock_cells; ++lane) best = best > lanes[lane] ? best : lanes[lane];
  return best;
}

void find_targets(const KernelReading& reading, const Block* blocks, int known, const KernelCells& cells,
                  SectorTargets& best) {
  const KernelReading r = reading;
  const KernelCells c = cells;
  const float density_scale = r.is_echo ? kPerSqrtTwoPi : 0.0F;
  const auto sectors = static_cast<float>(r.sectors);
  int blockers = 0;
  int sources = 0;
  for (int i = 0; i < known; ++i) {
    const int at = c.known[i] * kBlock_cells;
    const Ints log_odds = widened(load<Shorts>(blocks[c.known[i]].cells));
    const Floats p = 1.0F / (1.0F + exp_of(larger(to_floats(log_odds) * (-1.0F / 256.0F), all(-80.0F))));
    const Floats answer = where(log_odds >= r.believed_from, -p * load<Floats>(c.evidence + at));
    const auto range = load<Floats>(c.range_m + at);
    const Floats per_delta = 1.0F / (r.delta_m + r.delta_per_m * range);
    const Floats z = (r.range_m - range) * per_delta;
    const Floats bounded = smaller(larger(z, all(-12.0F)), all(12.0F));
    const Floats density = answer * density_scale * per_delta * exp_of(-0.5F * bounded * bounded);
    const Floats place = (0.5F * sectors) * (load<Floats>(c.off + at) + 1.0F);
    const Ints sector = to_ints(larger(smaller(place, all(sectors - 0.5F)), Floats{}));
    append_if_any(where(z > 3.0F, answer), sector, c.blockers, blockers);
    append_if_any(density, sector, c.sources, sources);
  }
  for (int k = 0; k < r.sectors; ++k) {
    best.blocking[k] = largest_of(c.blockers, blockers, k);
    best.density_per_m[k] = largest_of(c.sources, sources, k);
  }
}

void compare_blocks(const KernelReading& reading, int near, const KernelCells& cells) {
  const KernelReading r = reading;
  const float hit_scale = r.is_echo ? kPerSqrtTwoPi * r.per_false_echo_m : 0.0F;
  for (int i = 0; i < near; ++i) {
    const int at = cells.near[i] * kBlock_cells;
    const auto range = load<Floats>(cells.range_m + at);
    const Floats per_delta = 1.0F / (r.delta_m + r.delta_per_m * range);
    const Floats z = smaller(larger((r.range_m - range) * per_delta, all(-12.0F)), all(12.0F));
    const Floats bell = exp_of(-0.5F * z * z);
    const Floats hit = bell * per_delta * hit_scale;
    store(cells.evidence + at, load<Floats>(cells.evidence + at) * (normal_integral(z, bell) - hit));
  }
}

CAIRN_INLINE Floats increment_of(const Floats& evidence, float weight) {
  return quanta_of_ln(1.0F + weight * evidence);
}

bool says_something(const float* evidence, const KernelScale& scale, int count) {
  for (int i = 0; i < count; i += kBlock_cells) {
    const Floats increment = increment_of(load<Floats>(evidence + i), scale.weight);
    if (any((increment >= 0.5F) | (increment <= -0.5F))) return true;
  }
  return false;
}

// The change after the log's weight; counts it there.
template <bool two_planes>
CAIRN_INLINE Floats logged(const KernelLog& log, const Floats& off, const Floats& weight_of_count,
                           std::uint16_t* counts, const Floats& change) {
  // Unsigned, for cells that are not of the beam have any bearing.
  const auto bucket = reinterpret_cast<Words>(to_ints(off * log.buckets_per_off + log.buckets_to_axis));
  const Words shifts = (2 * bucket + static_cast<std::uint32_t>(log.shift)) & 31;
  Words words = widened(load<Counts>(counts));
  if constexpr (two_planes) words |= widened(load<Counts>(counts + log.plane_step)) << 16;
  const Words count = (words >> shifts) & 3;
  const Floats weight = entry(weight_of_count, reinterpret_cast<Ints>(count));
  const Ints taken = (larger(change, -change) >= 0.5F) & (weight > 0.0F) & 1;
  words += reinterpret_cast<Words>(taken) << shifts;
  store(counts, narrowed(words & 0xffff));
  if constexpr (two_planes) store(counts + log.plane_step, narrowed(words >> 16));
  return change * weight;
}

template <bool has_log, bool two_planes>
CAIRN_INLINE void apply(const KernelScale& by, const KernelLog& log, const Block* blocks, int count,
                        const KernelCells& cells) {
  const auto weight_of_count = load<Floats>(by.weight_of_count);
  const float weight = by.weight;
  const Shorts highest = Shorts{} + static_cast<std::int16_t>(by.clamp);
  const Shorts lowest = -highest;
  for (int b = 0; b < count; ++b) {
    const Block& block = blocks[b];
    Floats change = increment_of(load<Floats>(cells.evidence + b * kBlock_cells), weight);
    if constexpr (has_log)
      change = logged<two_planes>(log, load<Floats>(cells.off + b * kBlock_cells), weight_of_count, block.log, change);
    const Shorts before = load<Shorts>(block.cells);
    Shorts after = before + narrowed(rounded(change));
    after = after > highest ? highest : after;
    after = after < lowest ? lowest : after;
    store(block.cells, after);
    cells.moved[b] = bits_of(after != before);
  }
}

void apply_blocks(const KernelScale& scale, const KernelLog& log, const Block* blocks, int count,
                  const KernelCells& cells) {
  const KernelLog by = log;
  const KernelCells to = cells;
  if (!by.is_on) return apply<false, false>(scale, by, blocks, count, to);
  if (by.plane_step == 0) return apply<true, false>(scale, by, blocks, count, to);
  apply<true, true>(scale, by, blocks, count, to);
}

constexpr Kernels kKernels{place_blocks, find_targets, compare_blocks, says_something, apply_blocks};

}  // namespace
}  // namespace cairn::muriel
