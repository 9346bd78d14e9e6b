#include "plugins/template_matcher/match_kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plugins/template_matcher/match_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::template_matcher {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<std::uint16_t, kPlacesPerPiece>;
using SignedTag = hn::RebindToSigned<Tag>;

constexpr std::size_t kCellsBetweenChecks = 16;
constexpr std::size_t kCellsTogether = 4;

void ProjectOnAxis(const ProjectionRows& rows, int k, std::uint16_t* along, std::uint16_t* against,
                   std::size_t stride) {
  const SignedTag d;
  const Tag du;
  const Direction u = direction(k);
  const auto ux = hn::Set(d, u.x);
  const auto uy = hn::Set(d, u.y);
  const auto offset = hn::Set(d, static_cast<std::int16_t>(rows.offset + 1));
  const auto two = hn::Set(d, std::int16_t{2});
  for (std::size_t row = 0; row < rows.height; ++row) {
    const std::int16_t* x = rows.x + row * rows.gradient_stride;
    const std::int16_t* y = rows.y + row * rows.gradient_stride;
    for (std::size_t i = 0; i < rows.width; i += hn::Lanes(d)) {
      // Four times the projection; each product is rounded down, so up to 2 is missing.
      const auto low = hn::Add(hn::MulHigh(hn::ShiftLeft<4>(hn::LoadU(d, x + i)), ux),
                               hn::MulHigh(hn::ShiftLeft<4>(hn::LoadU(d, y + i)), uy));
      const auto high = hn::Add(low, two);
      const int shift = rows.shift + 2;
      hn::StoreU(hn::BitCast(du, hn::Add(hn::ShiftRightSame(high, shift), offset)), du, along + row * stride + i);
      hn::StoreU(hn::BitCast(du, hn::Add(hn::ShiftRightSame(hn::Neg(low), shift), offset)), du,
                 against + row * stride + i);
    }
  }
}

void Project(const ProjectionRows& rows, std::uint16_t* maps, std::size_t map_size, std::size_t stride) {
  for (int k = 0; k < kDirections / 2; ++k) {
    ProjectOnAxis(rows, k, maps + static_cast<std::size_t>(k) * map_size,
                  maps + static_cast<std::size_t>(k + kDirections / 2) * map_size, stride);
  }
}

// One row of the pooled maps of one row parity.
void PoolRow(const std::uint16_t* lower, const std::uint16_t* upper, std::size_t width, std::uint8_t* even,
             std::uint8_t* odd) {
  const Tag d;
  const hn::Rebind<std::uint8_t, Tag> db;
  const hn::RebindToSigned<Tag> ds;
  const std::size_t lanes = hn::Lanes(d);
  const auto most = [&](std::size_t i) HWY_ATTR {
    return hn::Max(hn::Max(hn::LoadU(d, lower + i), hn::LoadU(d, lower + i + 1)),
                   hn::Max(hn::LoadU(d, upper + i), hn::LoadU(d, upper + i + 1)));
  };
  for (std::size_t i = 0; i < width; i += 2 * lanes) {
    const auto one = hn::Set(d, std::uint16_t{1});
    const auto coarse = [&](auto v) HWY_ATTR {
      return hn::DemoteTo(db, hn::BitCast(ds, hn::ShiftRight<kCoarserBits>(hn::Add(v, one))));
    };
    const auto left = most(i);
    const auto right = most(i + lanes);
#if HWY_TARGET == HWY_SCALAR
    hn::StoreU(coarse(left), db, even + i / 2);
    hn::StoreU(coarse(right), db, odd + i / 2);
#else
    hn::StoreU(coarse(hn::ConcatEven(d, right, left)), db, even + i / 2);
    hn::StoreU(coarse(hn::ConcatOdd(d, right, left)), db, odd + i / 2);
#endif
  }
}

void Pool(const ProjectionMaps& from, std::size_t width, std::size_t height, std::uint8_t* maps, std::size_t map_size,
          std::size_t stride) {
  for (std::size_t k = 0; k < kDirections; ++k) {
    for (std::size_t row = 0; row < height; ++row) {
      const std::uint16_t* lower = from.first + k * from.map_size + row * from.stride;
      std::uint8_t* even = maps + (4 * k + 2 * (row % 2)) * map_size + row / 2 * stride;
      PoolRow(lower, lower + from.stride, width, even, even + map_size);
    }
  }
}

std::size_t CollectBelow(const std::uint16_t* sums, std::size_t count, std::uint16_t limit, std::uint32_t* places) {
  const Tag d;
  const auto below = hn::Set(d, limit);
  std::size_t found = 0;
  for (std::size_t place = 0; place < count; place += hn::Lanes(d)) {
    const auto here = hn::LoadU(d, sums + place);
    if (hn::AllTrue(d, hn::Eq(hn::Max(here, below), here))) continue;
    for (std::size_t i = place; i < place + hn::Lanes(d); ++i) {
      if (sums[i] < limit) places[found++] = static_cast<std::uint32_t>(i);
    }
  }
  return found;
}

#if HWY_TARGET == HWY_SCALAR
void SumBlockShortfalls(const std::uint8_t* maps, std::span<const BoundCell> cells, std::uint16_t limit,
                        const std::uint16_t* start, std::size_t count, std::uint16_t* sums) {
  for (std::size_t place = 0; place < count; ++place) {
    std::uint32_t sum = start[place];
    for (std::size_t i = 0; i < cells.size() && sum < limit; ++i) {
      const std::uint32_t here = maps[cells[i].value + place];
      sum += std::max<std::uint32_t>(cells[i].wanted, here) - here;
    }
    sums[place] = static_cast<std::uint16_t>(std::min<std::uint32_t>(sum, 65535));
  }
}
#else
using ByteTag = hn::Repartition<std::uint8_t, Tag>;

void SumBlockShortfalls(const std::uint8_t* maps, std::span<const BoundCell> cells, std::uint16_t limit,
                        const std::uint16_t* start, std::size_t count, std::uint16_t* sums) {
  const Tag d;
  const ByteTag db;
  const std::size_t lanes = hn::Lanes(db);
  const auto enough = hn::Set(d, limit);
  const auto low = hn::Set(d, std::uint16_t{0xFF});
  for (std::size_t place = 0; place < count; place += 2 * lanes) {
    auto a_even = hn::Zero(d), a_odd = hn::Zero(d), b_even = hn::Zero(d), b_odd = hn::Zero(d);
    hn::LoadInterleaved2(d, start + place, a_even, a_odd);
    hn::LoadInterleaved2(d, start + place + lanes, b_even, b_odd);
    for (std::size_t i = 0; i < cells.size();) {
      const auto least = hn::Min(hn::Min(a_even, a_odd), hn::Min(b_even, b_odd));
      if (hn::AllTrue(d, hn::Eq(hn::Max(least, enough), least))) break;
      const std::size_t stop = std::min(i + kCellsBetweenChecks, cells.size());
      while (i < stop) {
        auto a = hn::Zero(db);
        auto b = hn::Zero(db);
        const std::size_t together = std::min(i + kCellsTogether, stop);
        for (; i < together; ++i) {
          const std::uint8_t* map = maps + cells[i].value + place;
          const auto wanted = hn::Set(db, static_cast<std::uint8_t>(cells[i].wanted));
          a = hn::SaturatedAdd(a, hn::SaturatedSub(wanted, hn::LoadU(db, map)));
          b = hn::SaturatedAdd(b, hn::SaturatedSub(wanted, hn::LoadU(db, map + lanes)));
        }
        a_even = hn::SaturatedAdd(a_even, hn::And(hn::BitCast(d, a), low));
        a_odd = hn::SaturatedAdd(a_odd, hn::ShiftRight<8>(hn::BitCast(d, a)));
        b_even = hn::SaturatedAdd(b_even, hn::And(hn::BitCast(d, b), low));
        b_odd = hn::SaturatedAdd(b_odd, hn::ShiftRight<8>(hn::BitCast(d, b)));
      }
    }
    hn::StoreInterleaved2(a_even, a_odd, d, sums + place);
    hn::StoreInterleaved2(b_even, b_odd, d, sums + place + lanes);
  }
}

#endif

void SumPieceShortfalls(const std::uint16_t* maps, std::span<const BoundCell> cells, std::uint16_t limit,
                        const std::uint16_t* start, std::size_t place, std::uint16_t* sums) {
  const Tag d;
  const auto enough = hn::Set(d, limit);
  for (std::size_t done = 0; done < kPlacesPerPiece; done += hn::Lanes(d)) {
    auto sum = hn::LoadU(d, start + place + done);
    for (std::size_t i = 0; i < cells.size();) {
      if (hn::AllTrue(d, hn::Eq(hn::Max(sum, enough), sum))) break;
      const std::size_t stop = std::min(i + kCellsBetweenChecks, cells.size());
      for (; i < stop; ++i) {
        const auto here = hn::LoadU(d, maps + cells[i].value + place + done);
        sum = hn::SaturatedAdd(sum, hn::SaturatedSub(hn::Set(d, cells[i].wanted), here));
      }
    }
    hn::StoreU(sum, d, sums + done);
  }
}

void SumDistances(const std::int16_t* x, const std::int16_t* y, std::ptrdiff_t stride,
                  std::span<const GradientCell> cells, std::int32_t limit, std::int32_t* sums) {
  const hn::CappedTag<float, kPlacesPerExactPiece> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::int16_t, decltype(d)> dh;
  const auto load = [&](const std::int16_t* from)
                        HWY_ATTR { return hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(dh, from))); };
  const auto most = hn::Set(di, limit);
  for (std::size_t done = 0; done < kPlacesPerExactPiece; done += hn::Lanes(d)) {
    auto sum = hn::Zero(di);
    for (std::size_t i = 0; i < cells.size();) {
      const std::size_t stop = std::min(i + kCellsBetweenChecks, cells.size());
      for (; i < stop; ++i) {
        const GradientCell& cell = cells[i];
        const std::ptrdiff_t at = cell.y * stride + cell.x + static_cast<std::ptrdiff_t>(done);
        const auto dx = hn::Sub(load(x + at), hn::Set(d, static_cast<float>(cell.gradient_x)));
        const auto dy = hn::Sub(load(y + at), hn::Set(d, static_cast<float>(cell.gradient_y)));
        // As gradient_distance(): all but the root is exact, and the root is rounded correctly.
        const auto root = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
        const auto scaled = hn::Add(hn::Mul(root, hn::Set(d, 16.0F)), hn::Set(d, 0.5F));
        sum = hn::Add(sum, hn::ConvertTo(di, scaled));
      }
      if (hn::AllTrue(di, hn::Gt(sum, most))) break;
    }
    hn::StoreU(sum, di, sums + done);
  }
}

std::int32_t SumDistance(const std::int32_t* both, std::ptrdiff_t stride, const GradientColumns& cells,
                         std::int32_t limit) {
  const hn::CappedTag<float, kPlacesPerExactPiece> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto row = hn::Set(di, static_cast<std::int32_t>(stride));
  auto sums = hn::Zero(di);
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d)) {
    const auto at = hn::Add(hn::Mul(hn::LoadU(di, cells.y.data() + i), row), hn::LoadU(di, cells.x.data() + i));
    const auto here = hn::GatherIndex(di, both, at);
    const auto x = hn::ConvertTo(d, hn::ShiftRight<16>(hn::ShiftLeft<16>(here)));
    const auto y = hn::ConvertTo(d, hn::ShiftRight<16>(here));
    const auto dx = hn::Sub(x, hn::LoadU(d, cells.gradient_x.data() + i));
    const auto dy = hn::Sub(y, hn::LoadU(d, cells.gradient_y.data() + i));
    const auto root = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
    const auto scaled = hn::Add(hn::Mul(root, hn::Set(d, 16.0F)), hn::Set(d, 0.5F));
    const auto distance = hn::ConvertTo(di, scaled);
    sums = hn::Add(sums, hn::IfThenElseZero(hn::FirstN(di, cells.count - i), distance));
    const bool is_time = (i + hn::Lanes(d)) % (2 * kPlacesPerExactPiece) == 0;
    if (is_time && hn::GetLane(hn::SumOfLanes(di, sums)) > limit) break;
  }
  return hn::GetLane(hn::SumOfLanes(di, sums));
}

}  // namespace HWY_NAMESPACE
}  // namespace cairn::template_matcher
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::template_matcher {

HWY_EXPORT(Project);
HWY_EXPORT(Pool);
HWY_EXPORT(SumBlockShortfalls);
HWY_EXPORT(SumPieceShortfalls);
HWY_EXPORT(SumDistances);
HWY_EXPORT(CollectBelow);
HWY_EXPORT(SumDistance);

namespace {

std::array<Direction, kDirections> all_directions() {
  constexpr double kOne = 16384.0;
  std::array<Direction, kDirections> all{};
  for (std::size_t k = 0; k < kDirections / 2; ++k) {
    const double angle_rad = 2.0 * std::numbers::pi * static_cast<double>(k) / kDirections;
    // The tiny allowance keeps the axes whole: a length of 1 + 1e-9 is cut to 1.
    const auto part = [](double value) { return static_cast<std::int16_t>(std::trunc(kOne * value * (1.0 + 1e-12))); };
    all[k] = {part(std::cos(angle_rad)), part(std::sin(angle_rad))};
    all[k + kDirections / 2] = {static_cast<std::int16_t>(-all[k].x), static_cast<std::int16_t>(-all[k].y)};
  }
  return all;
}

}  // namespace

Direction direction(int k) {
  static const std::array<Direction, kDirections> kAll = all_directions();
  return kAll[static_cast<std::size_t>(k)];
}

void project(const ProjectionRows& rows, std::uint16_t* maps, std::size_t map_size, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(Project)(rows, maps, map_size, stride);
}

void pool(const ProjectionMaps& from, std::size_t width, std::size_t height, std::uint8_t* maps, std::size_t map_size,
          std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(Pool)(from, width, height, maps, map_size, stride);
}

void sum_block_shortfalls(const std::uint8_t* maps, std::span<const BoundCell> cells, std::uint16_t limit,
                          const std::uint16_t* start, std::size_t count, std::uint16_t* sums) {
  HWY_DYNAMIC_DISPATCH(SumBlockShortfalls)(maps, cells, limit, start, count, sums);
}

void sum_segment_shortfalls(const std::uint16_t* maps, std::span<const BoundCell> cells, std::uint16_t limit,
                            const std::uint16_t* start, std::size_t place, std::uint16_t* sums) {
  HWY_DYNAMIC_DISPATCH(SumPieceShortfalls)(maps, cells, limit, start, place, sums);
}

std::size_t collect_below(const std::uint16_t* sums, std::size_t count, std::uint16_t limit, std::uint32_t* places) {
  return HWY_DYNAMIC_DISPATCH(CollectBelow)(sums, count, limit, places);
}

void sum_distances(const std::int16_t* x, const std::int16_t* y, std::ptrdiff_t stride,
                   std::span<const GradientCell> cells, std::int32_t limit, std::int32_t* sums) {
  HWY_DYNAMIC_DISPATCH(SumDistances)(x, y, stride, cells, limit, sums);
}

std::int32_t sum_distance(const std::int32_t* both, std::ptrdiff_t stride, const GradientColumns& cells,
                          std::int32_t limit) {
  return HWY_DYNAMIC_DISPATCH(SumDistance)(both, stride, cells, limit);
}

void GradientColumns::push_back(const GradientCell& cell) {
  ++count;
  for (auto* column : {&x, &y}) column->resize(count + kPlacesPerExactPiece);
  for (auto* column : {&gradient_x, &gradient_y}) column->resize(count + kPlacesPerExactPiece);
  x[count - 1] = cell.x;
  y[count - 1] = cell.y;
  gradient_x[count - 1] = cell.gradient_x;
  gradient_y[count - 1] = cell.gradient_y;
}

}  // namespace cairn::template_matcher
#endif
