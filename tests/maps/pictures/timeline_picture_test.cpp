#include "maps/pictures/timeline_picture.hpp"

#include <gtest/gtest.h>

#include "tests/maps/pictures/picture_fixture.hpp"

namespace cairn {
namespace {

using namespace pictures;

constexpr Colour kSuccess = kStart;
constexpr Colour kFailure = kClosed;
constexpr Colour kHalted = kPlanned;

class TimelinePictures : public Pictures {
 protected:
  [[nodiscard]] Png drawn(const Timeline& timeline) const {
    write_timeline_picture(file(), timeline);
    return read_png(file());
  }
  static Timeline of(std::vector<TimelineRow> rows) { return {"a mission", "done", 0.0, 100.0, {}, std::move(rows)}; }
};

// Pixels beyond those of the legend, which shows each colour once.
long added(const Png& with, const Png& without, Colour colour) {
  return with.count(colour) - without.count(colour);
}

TEST_F(TimelinePictures, DrawABarAsLongAsItsTimeInTheColourOfItsEnd) {
  const Png nothing = drawn(of({{"1  wait", 0, {}}}));
  for (const auto& [kind, colour] : {std::pair(BarKind::success, kSuccess), std::pair(BarKind::failure, kFailure),
                                     std::pair(BarKind::halted, kHalted)}) {
    const long half = added(drawn(of({{"1  wait", 0, {{0.0, 50.0, kind}}}})), nothing, colour);
    const long quarter = added(drawn(of({{"1  wait", 0, {{50.0, 75.0, kind}}}})), nothing, colour);
    EXPECT_GT(quarter, 1000);
    EXPECT_NEAR(static_cast<double>(half) / static_cast<double>(quarter), 2.0, 0.05);
  }
}

TEST_F(TimelinePictures, AreLaterFurtherRightAndTheNextRowFurtherDown) {
  const Png nothing = drawn(of({{"1  a", 0, {}}, {"2  b", 0, {}}}));
  const auto centre = [&](std::size_t row, double begin_s) {
    std::vector<TimelineRow> rows{{"1  a", 0, {}}, {"2  b", 0, {}}};
    rows[row].bars = {{begin_s, begin_s + 10.0, BarKind::halted}};
    const Png png = drawn(of(std::move(rows)));
    const auto n = static_cast<double>(png.count(kHalted));
    const auto legend = static_cast<double>(nothing.count(kHalted));
    return Pixel((png.centre_of(kHalted) * n - nothing.centre_of(kHalted) * legend) / (n - legend));
  };
  const Pixel early = centre(0, 0.0);
  EXPECT_NEAR(centre(0, 50.0).x() - early.x(), 430.0, 2.0) << "half of the 860 pixels of the whole time";
  EXPECT_NEAR(centre(0, 50.0).y(), early.y(), 0.5);
  EXPECT_NEAR(centre(1, 0.0).y() - early.y(), 22.0, 0.5);
}

TEST_F(TimelinePictures, CutOffWhatLiesOutsideTheTime) {
  const Png nothing = drawn(of({{"1  wait", 0, {}}}));
  const Png whole = drawn(of({{"1  wait", 0, {{0.0, 100.0, BarKind::success}}}}));
  const Png more = drawn(of({{"1  wait", 0, {{-500.0, 1e9, BarKind::success}}}}));
  EXPECT_EQ(added(whole, nothing, kSuccess), added(more, nothing, kSuccess));
}

TEST_F(TimelinePictures, HaveARowOfMarksForEachKindThatWasGiven) {
  Timeline timeline = of({{"1  wait", 0, {}}});
  const Png without = drawn(timeline);
  timeline.marks = {{"slowed down", MarkKind::stop, {{20.0, 30.0, ""}}},
                    {"bumped", MarkKind::bump, {{50.0, 50.0, ""}}}};
  const Png with = drawn(timeline);
  EXPECT_EQ(with.height - without.height, 2 * 22 + 8);
  EXPECT_GT(added(with, without, kPlanned), 800) << "ten seconds slowed down";
  EXPECT_GT(added(with, without, kClosed), 10) << "a touch has no length, and is seen all the same";
}

TEST_F(TimelinePictures, OfAMissionWithoutTimeOrRowsAreDrawnToo) {
  EXPECT_GT(drawn({"nothing", "cancelled", 3.0, 3.0, {}, {}}).width, 100);
}

TEST_F(TimelinePictures, RefuseMoreRowsThanAPictureHolds) {
  EXPECT_THROW(write_timeline_picture(file(), of(std::vector<TimelineRow>(kMaxTimelineRows + 1))), std::runtime_error);
}

}  // namespace
}  // namespace cairn
