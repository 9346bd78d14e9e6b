// Outlines that are not given corner by corner: arcs, and the outline of a thing in a picture. Both become
// polygons, which is all that the rest of Cairn knows beside the circle.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "maps/geometry/contour.hpp"

namespace cairn {

// Replaces sides by arcs. bulges[i] bends the side from corner i to the next: the tangent of a quarter of
// the arc's angle, above 0 to the right of the way (outward, for anticlockwise corners), 0 a straight side,
// 1 half a circle. The chords stay within 1 mm of the arc and turn by at most 15 degrees, so that no corner
// of theirs is sharp enough to echo. Throws std::invalid_argument unless there is one finite bulge a corner.
[[nodiscard]] std::vector<Point> with_arcs(std::span<const Point> corners_m, std::span<const double> bulges);

inline constexpr int kMaxPictureSide_px = 1024;
inline constexpr std::size_t kMaxPictureCorners = 2000;

// The outline of what stands in a PNG picture: every pixel that differs in brightness (below or above the
// middle) from most of the picture's rim. Transparent counts as white. Several pieces become several
// parts; pieces that touch only with a corner count as one, holes as filled, since no sensor looks in from
// outside. Up in the picture is +y; the outline stays within 3/4 of a pixel of the pixels' edges. Throws
// std::invalid_argument for a file that is missing, no PNG, too large, of one colour or too ragged.
[[nodiscard]] Contour contour_in_picture(const std::filesystem::path& file, double pixel_m);

}  // namespace cairn
