#include "plugins/template_matcher/gradient_field.hpp"

namespace cairn::template_matcher {

void GradientField::look_at(const OccupancyGrid& grid, const CellBox& box) {
  box_ = box;
  const CellBox read = box.grown(1);
  const auto stride = static_cast<std::size_t>(read.width());
  ol_.resize(stride * static_cast<std::size_t>(read.height()));
  grid.copy_ol(read, ol_);
  const std::size_t size = static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()) + kPadding;
  x_.resize(size);
  y_.resize(size);
  both_.resize(size);
  for (int row = 0; row < box.height(); ++row) {
    const std::uint8_t* __restrict below = ol_.data() + static_cast<std::size_t>(row) * stride;
    const std::uint8_t* __restrict level = below + stride;
    const std::uint8_t* __restrict above = level + stride;
    std::int16_t* __restrict x = x_.data() + index_of({box.min.x, box.min.y + row});
    std::int16_t* __restrict y = y_.data() + index_of({box.min.x, box.min.y + row});
    std::int32_t* __restrict both = both_.data() + index_of({box.min.x, box.min.y + row});
    for (int i = 0; i < box.width(); ++i) {
      const int right = below[i + 2] + 2 * level[i + 2] + above[i + 2];
      const int left = below[i] + 2 * level[i] + above[i];
      const int upper = above[i] + 2 * above[i + 1] + above[i + 2];
      const int lower = below[i] + 2 * below[i + 1] + below[i + 2];
      x[i] = static_cast<std::int16_t>(right - left);
      y[i] = static_cast<std::int16_t>(upper - lower);
    }
    for (int i = 0; i < box.width(); ++i) both[i] = y[i] * 65536 + (x[i] & 0xFFFF);
  }
}

}  // namespace cairn::template_matcher
