#include "plugins/template_matcher/gradient_field.hpp"

#include <algorithm>

namespace cairn::template_matcher {

void GradientField::look_at(const OccupancyGrid& grid, const CellBox& box, std::optional<std::int32_t> unseen_cost) {
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
  unseen_cost_ = unseen_cost.value_or(0);
  if (unseen_cost) mark_unseen();
}

void GradientField::mark_unseen() {
  const auto stride = static_cast<std::size_t>(box_.width()) + 2;
  known_.resize(ol_.size());
  for (std::size_t i = 0; i < ol_.size(); ++i)
    known_[i] = static_cast<std::uint8_t>(ol_[i] < 127 - kUnseenBand || ol_[i] > 127 + kUnseenBand);
  for (int row = 0; row < box_.height(); ++row) {
    const std::uint8_t* __restrict below = known_.data() + static_cast<std::size_t>(row) * stride;
    const std::uint8_t* __restrict level = below + stride;
    const std::uint8_t* __restrict above = level + stride;
    const std::size_t first = index_of({box_.min.x, box_.min.y + row});
    for (int i = 0; i < box_.width(); ++i) {
      const int any = below[i] | below[i + 1] | below[i + 2] | level[i] | level[i + 1] | level[i + 2] | above[i] |
                      above[i + 1] | above[i + 2];
      const std::size_t here = first + static_cast<std::size_t>(i);
      x_[here] = any != 0 ? x_[here] : kUnseen;
      both_[here] = any != 0 ? both_[here] : std::int32_t{kUnseen} & 0xFFFF;
    }
  }
}

}  // namespace cairn::template_matcher
