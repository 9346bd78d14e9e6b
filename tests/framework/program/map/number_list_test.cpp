#include "framework/program/map/number_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<double> numbers(const std::string& text) {
  return number_list(text, "x,y,deg", "map merge: --transform", 100.0);
}

TEST(NumberList, HoldsAsManyNumbersAsItHasNames) {
  EXPECT_THAT(numbers("1,-2.5,90"), ElementsAre(1.0, -2.5, 90.0));
  EXPECT_THAT(numbers(" 1 , 2,3e1 "), ElementsAre(1.0, 2.0, 30.0));
  EXPECT_THAT(numbers("[1, 2, 30]"), ElementsAre(1.0, 2.0, 30.0));
  EXPECT_THAT(numbers("100,-100,0"), ElementsAre(100.0, -100.0, 0.0));
}

TEST(NumberList, RefusesTooFewTooManyAndWhatIsNoNumber) {
  for (const char* text : {"", "1,2", "1,2,3,4", "1,,3", "1,2,", "1,2,north", "1;2;3"})
    EXPECT_THROW((void)numbers(text), std::runtime_error) << text;
}

TEST(NumberList, RefusesNumbersThatAreTooLargeOrNotFinite) {
  for (const char* text : {"100.1,0,0", "0,-101,0", "0,0,nan", "inf,0,0"})
    EXPECT_THROW((void)numbers(text), std::runtime_error) << text;
}

TEST(NumberList, SaysWhatItIsWhatIsAllowedAndWhatWasFound) {
  EXPECT_THAT([] { (void)numbers("1,2"); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("map merge: --transform must be x,y,deg, finite numbers within +-100 "),
                        HasSubstr("found \"1,2\""))));
}

}  // namespace
}  // namespace cairn
