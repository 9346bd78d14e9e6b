#include "maps/base/json_text.hpp"

#include "tests/maps/exchange/exchange_fixture.hpp"

namespace cairn::exchange {
namespace {

TEST(JsonText, FindsWhereAPathLeads) {
  const std::string text = R"({"a": [1, {"b\"]": "x}", "c": [[], 7]}], "d": 2})";
  const SourceText source(text, "a.json");
  EXPECT_EQ(text.substr(offset_of(source, 0, {"a", "1", "c", "1"}), 2), "7]");
  EXPECT_EQ(text.substr(offset_of(source, 0, {"d"}), 2), "2}");
  EXPECT_EQ(text.substr(offset_of(source, 0, {"a", "1", "missing"}), 4), "{\"b\\") << "the last part that is there";
  EXPECT_EQ(text.substr(offset_of(source, 0, {"a", "9"}), 3), "[1,");
}

TEST(JsonText, SlicesItemsAndMembers) {
  const std::string text = R"( {"a": [1, "x,y", {"k": [2]}], "b": null} )";
  const SourceText source(text, "a.json");
  std::size_t end = 0;
  const std::vector<JsonMember> members = members_at(source, 0, end);
  ASSERT_EQ(members.size(), 2U);
  EXPECT_EQ(text.substr(end), " ");
  EXPECT_EQ(text.substr(members[1].begin, members[1].end - members[1].begin), "null");
  std::vector<std::string> items;
  for (const JsonSlice& item : items_at(source, members[0].begin))
    items.push_back(text.substr(item.begin, item.end - item.begin));
  EXPECT_THAT(items, testing::ElementsAre("1", "\"x,y\"", "{\"k\": [2]}"));
}

TEST(JsonText, KnowsObjects) {
  EXPECT_TRUE(is_json_object("{}"));
  EXPECT_TRUE(is_json_object(R"({"a": "[[[", "b": [1]})"));
  for (const char* none : {"", "[]", "1", "{", "{}}", "{} {}", R"({"a": nan})", "{\"a\": \"\xC3\"}"})
    EXPECT_FALSE(is_json_object(none)) << none;
  EXPECT_FALSE(is_json_object("{\"a\":" + std::string(100'000, '[') + std::string(100'000, ']') + "}"));
}

TEST(Utf8, FindsTheFirstByteThatIsNone) {
  EXPECT_EQ(first_not_utf8("a\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80"), std::string_view::npos);
  for (const char* bad : {"ab\x80", "ab\xC0\x80", "ab\xE0\x80\x80", "ab\xED\xA0\x80", "ab\xF4\x90\x80\x80", "ab\xFF",
                          "ab\xE2\x82", "ab\xC3("})
    EXPECT_EQ(first_not_utf8(bad), 2U);
}

}  // namespace
}  // namespace cairn::exchange
