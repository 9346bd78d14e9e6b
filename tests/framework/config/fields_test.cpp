#include "framework/config/fields.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <locale>

#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

using config_test::error_of;

enum class Gait { walk, trot };

struct Inner {
  double width_m = 0.5;
  int count = 3;
  static void describe(Fields<Inner>& fields) {
    fields.number("width_m", &Inner::width_m, {0.0, 2.0}, "m", "how wide").required = true;
    fields.integer("count", &Inner::count, {1, 10}, "how many");
    fields.shorthand("width_m");
  }
};

// A struct of its own that has other defaults inside than the inner ones have by themselves.
struct Middle {
  Inner inner{.width_m = 0.75, .count = 4};
  static void describe(Fields<Middle>& fields) { fields.group("inner", &Middle::inner, "what is inside"); }
};
struct Outer {
  Inner inner{.width_m = 1.25, .count = 7};
  Middle middle{.inner = {.width_m = 1.5, .count = 8}};
  Middle plain;
  std::optional<Inner> extra;
  static void describe(Fields<Outer>& fields) {
    fields.group("inner", &Outer::inner, "what is inside");
    fields.group("middle", &Outer::middle, "with a part");
    fields.group("plain", &Outer::plain, "the same, as it is by itself");
    fields.group("extra", &Outer::extra, "what may be there");
  }
};

struct Example {
  double speed_mps = 0.4;
  std::optional<double> limit_m;
  double turn_rad = radians(15.0);
  int cells = 5;
  std::uint64_t seed = 1;
  std::uint8_t small = 1;
  bool loud = false;
  std::string name = "none";
  Gait gait = Gait::trot;
  std::vector<Gait> gaits{Gait::walk};
  std::filesystem::path file;
  Point at_m{1.0, 2.0};
  std::vector<Point> corners_m;
  std::vector<double> weights;
  Inner inner;
  std::optional<Inner> extra;
  std::vector<Inner> many;
  PluginChoice planner;
  ConfigValue rest;
  static void describe(Fields<Example>& fields) {
    fields.number("speed_mps", &Example::speed_mps, {0.0, 2.0}, "m/s", "how fast");
    fields.number("limit_m", &Example::limit_m, {0.0}, "m", "how far");
    fields.angle("turn_deg", &Example::turn_rad, {-180.0, 180.0}, "how it is turned");
    fields.integer("cells", &Example::cells, {1, 100}, "how many cells");
    fields.integer("seed", &Example::seed, {}, "of the random generator");
    fields.integer("small", &Example::small, {}, "a small one");
    fields.flag("loud", &Example::loud, "whether it is loud");
    fields.text("name", &Example::name, "what it is called");
    fields.choice("gait", &Example::gait, {{"walk", Gait::walk}, {"trot", Gait::trot}}, "how it goes");
    fields.choices("gaits", &Example::gaits, {{"walk", Gait::walk}, {"trot", Gait::trot}}, "how it may go");
    fields.file("file", &Example::file, "where it is");
    fields.point("at_m", &Example::at_m, "m", "where it stands");
    fields.points("corners_m", &Example::corners_m, "m", "its corners");
    fields.numbers("weights", &Example::weights, {0.0, 1.0}, "", "its weights");
    fields.group("inner", &Example::inner, "what is inside");
    fields.group("extra", &Example::extra, "what may be there");
    fields.list("many", &Example::many, "many of them");
    fields.plugin("planner", &Example::planner, "planner", "who plans");
    fields.raw("rest", &Example::rest, "anything", "anything else");
  }
};

Example load(const std::string& text) {
  return load_config<Example>(parse_config_text(text, "/c/e.yaml"), "example");
}

std::string load_error(const std::string& text) {
  const std::string error = error_of([&] { (void)load(text); });
  return error.starts_with("/c/e.yaml:") ? error.substr(10) : error;
}

TEST(Fields, NothingGivenLeavesTheDefaults) {
  const Example example = load("");
  EXPECT_EQ(example.speed_mps, 0.4);
  EXPECT_FALSE(example.limit_m);
  EXPECT_FALSE(example.extra);
  EXPECT_EQ(example.gait, Gait::trot);
}

TEST(Fields, AListOfChoicesHoldsEachOnceAndAtLeastOne) {
  EXPECT_EQ(load("").gaits, std::vector{Gait::walk});
  EXPECT_EQ(load("gaits: [trot, walk, trot]").gaits, (std::vector{Gait::trot, Gait::walk}));
  EXPECT_EQ(load_error("gaits: [walk, trott]"),
            "1:15: gaits must be one of walk, trot, found \"trott\" (did you mean \"trot\"?)");
  EXPECT_EQ(load_error("gaits: []"), "1:8: gaits must name at least one of walk, trot");
  EXPECT_EQ(schema_of<Example>().fields[9].choices, (std::vector<std::string>{"walk", "trot"}));
}

TEST(Fields, LoadEveryType) {
  const Example example = load(
      "speed_mps: +1.5e-1\nlimit_m: .5\nturn_deg: 90\ncells: 7\nseed: 9223372036854775807\nsmall: 255\nloud: true\n"
      "name: 5\ngait: walk\nfile: ../a.txt\nat_m: [3, -4]\ncorners_m: [[0, 0], [1, 0]]\nweights: [0, 0.5]\n"
      "inner: {width_m: 1, count: 2}\nextra: 0.25\nmany: [1, {width_m: 2}]\n"
      "planner: {plugin: hybrid, deep: 3}\nrest: {a: 1}\n");
  EXPECT_EQ(example.speed_mps, 0.15);
  EXPECT_EQ(example.limit_m, 0.5);
  EXPECT_DOUBLE_EQ(example.turn_rad, std::numbers::pi / 2);
  EXPECT_EQ(example.cells, 7);
  EXPECT_EQ(example.seed, 9223372036854775807U);
  EXPECT_EQ(example.small, 255);
  EXPECT_TRUE(example.loud);
  EXPECT_EQ(example.name, "5");
  EXPECT_EQ(example.gait, Gait::walk);
  EXPECT_EQ(example.file, "/a.txt");
  EXPECT_EQ(example.at_m, Point(3, -4));
  EXPECT_EQ(example.corners_m.at(1), Point(1, 0));
  EXPECT_EQ(example.weights, (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(example.inner.count, 2);
  ASSERT_TRUE(example.extra);
  EXPECT_EQ(example.extra->width_m, 0.25) << "the shorthand";
  ASSERT_EQ(example.many.size(), 2U);
  EXPECT_EQ(example.many[1].width_m, 2.0);
  EXPECT_EQ(example.planner.name, "hybrid");
  EXPECT_EQ(example.planner.config.find("plugin"), nullptr);
  EXPECT_EQ(example.planner.config.find("deep")->place.text(), "/c/e.yaml:17:33");
  EXPECT_EQ(example.rest.find("a")->scalar, "1");
}

TEST(Fields, UnknownKeysNameTheNearest) {
  EXPECT_EQ(
      load_error("cells: 3\nspeed_mp: 1\n"),
      "2:1: unknown key \"speed_mp\" in example (did you mean \"speed_mps\"?); known: speed_mps, limit_m, "
      "turn_deg, cells, seed, small, loud, name, gait, gaits, file, at_m, corners_m, weights, inner, extra, many, "
      "planner, rest");
  EXPECT_EQ(load_error("inner: {width_m: 1, size: 1}"), "1:21: unknown key \"size\" in inner; known: width_m, count");
}

struct Empty {
  static void describe(Fields<Empty>&) {}
};

TEST(Fields, WithoutSettingsEveryKeyIsUnknown) {
  EXPECT_EQ(error_of([] { (void)load_config<Empty>(parse_config_text("a: 1", "m.yaml"), "plugin nap"); }),
            "m.yaml:1:1: unknown key \"a\" in plugin nap; it takes none");
}

TEST(Fields, NumbersSayWhatIsAllowedAndWhatWasFound) {
  EXPECT_EQ(load_error("speed_mps: 3"), "1:12: speed_mps must be a number from 0 to 2 m/s, found \"3\"");
  EXPECT_EQ(load_error("speed_mps: fast"), "1:12: speed_mps must be a number from 0 to 2 m/s, found \"fast\"");
  EXPECT_EQ(load_error("speed_mps: [1]"), "1:12: speed_mps must be a number from 0 to 2 m/s, found a list");
  EXPECT_EQ(load_error("speed_mps:"), "1:1: speed_mps must be a number from 0 to 2 m/s, found nothing");
  EXPECT_EQ(load_error("speed_mps: '1'"),
            "1:12: speed_mps must be a number from 0 to 2 m/s, found the text \"1\" (leave out the quotes)");
  EXPECT_EQ(load_error("limit_m: -1"), "1:10: limit_m must be a number of at least 0 m, found \"-1\"");
  EXPECT_EQ(load_error("turn_deg: 181"), "1:11: turn_deg must be a number from -180 to 180 deg, found \"181\"");
  EXPECT_EQ(load_error("weights: [0, 2]"), "1:14: each item of weights must be a number from 0 to 1, found \"2\"");
  EXPECT_EQ(load_error("weights: 2"), "1:10: weights must be a list of numbers, found \"2\"");
}

TEST(Fields, NumbersAreWholeFiniteTokens) {
  for (const char* text : {".inf", "-.inf", ".nan", "inf", "nan", "infinity", "1e999", "0x10", "1_000", "1,5", "1.5m",
                           "1 2", "+-1", "++1", "--1", "1e", "."}) {
    EXPECT_EQ(load_error(std::string("limit_m: ") + text),
              std::string("1:10: limit_m must be a number of at least 0 m, found \"") + text + "\"");
  }
}

TEST(Fields, NumbersDoNotDependOnTheLocale) {
  const char* comma_locale = nullptr;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    if (comma_locale == nullptr) comma_locale = std::setlocale(LC_ALL, name);
  }
  EXPECT_EQ(load("speed_mps: 1.5").speed_mps, 1.5);
  EXPECT_EQ(config_detail::number_text(1.5), "1.5");
  std::setlocale(LC_ALL, "C");
}

TEST(Fields, IntegersAreWholeAndFitTheirType) {
  EXPECT_EQ(load_error("cells: 3.5"), "1:8: cells must be a whole number from 1 to 100, found \"3.5\"");
  EXPECT_EQ(load_error("cells: 0"), "1:8: cells must be a whole number from 1 to 100, found \"0\"");
  EXPECT_EQ(load_error("cells: 99999999999999999999"),
            "1:8: cells must be a whole number from 1 to 100, found \"99999999999999999999\"");
  EXPECT_EQ(load_error("seed: -1"), "1:7: seed must be a whole number of at least 0, found \"-1\"");
  EXPECT_EQ(load_error("small: 256"), "1:8: small must be a whole number from 0 to 255, found \"256\"");
}

TEST(Fields, OtherTypesSayWhatIsAllowedToo) {
  EXPECT_EQ(load_error("loud: yes"), "1:7: loud must be true or false, found \"yes\"");
  EXPECT_EQ(load_error("loud: 'true'"), "1:7: loud must be true or false, found the text \"true\"");
  EXPECT_EQ(load_error("name: [a]"), "1:7: name must be text, found a list");
  EXPECT_EQ(load_error("name:"), "1:1: name must be text, found nothing");
  EXPECT_EQ(load_error("gait: trott"), "1:7: gait must be one of walk, trot, found \"trott\" (did you mean \"trot\"?)");
  EXPECT_EQ(load_error("gait: {a: 1}"), "1:7: gait must be one of walk, trot, found a map");
  EXPECT_EQ(load_error("file: {}"), "1:7: file must be text, found a map");
  EXPECT_EQ(load_error("at_m: 3"), "1:7: at_m must be a point [x, y], found \"3\"");
  EXPECT_EQ(load_error("at_m: [1, 2, 3]"), "1:7: at_m must be a point [x, y], found a list of 3");
  EXPECT_EQ(load_error("at_m: [1, b]"), "1:11: y of at_m must be a number from -100000 to 100000 m, found \"b\"");
  EXPECT_EQ(load_error("at_m: [1e300, 0]"),
            "1:8: x of at_m must be a number from -100000 to 100000 m, found \"1e300\"");
  EXPECT_EQ(load_error("corners_m: [1, 2]"), "1:13: each item of corners_m must be a point [x, y], found \"1\"");
  EXPECT_EQ(load_error("corners_m: 1"), "1:12: corners_m must be a list of points [[x, y], ...], found \"1\"");
  EXPECT_EQ(load_error("many: {a: 1}"), "1:7: many must be a list, found a map");
  EXPECT_EQ(load_error("planner: hybrid"), "1:10: planner must be a map {plugin: NAME, ...}, found \"hybrid\"");
  EXPECT_EQ(load_error("planner: {a: 1}"), "1:10: planner lacks the key \"plugin\": which module does it");
  EXPECT_EQ(load_error("planner: {plugin: ''}"), "1:19: plugin must be the name of a module, found the text \"\"");
  EXPECT_EQ(load_error("[1, 2]"), "1:1: example must be a map, found a list");
  EXPECT_EQ(load_error("word"), "1:1: example must be a map, found \"word\"");
}

TEST(Fields, ALongListOfPointsIsRefused) {
  std::string text = "corners_m: [";
  for (int i = 0; i < 10'001; ++i) text += "[0,0],";
  EXPECT_EQ(load_error(text + "]"), "1:12: corners_m must be a list of at most 10000 points, found 10001");
}

TEST(Fields, ARequiredKeyIsMissedWhereItsMapStands) {
  EXPECT_EQ(load_error("cells: 3\ninner: {count: 2}"), "2:8: inner lacks the key \"width_m\": how wide");
  EXPECT_EQ(load_error("inner:"), "1:1: inner lacks the key \"width_m\": how wide");
  EXPECT_EQ(load_error("many: [{width_m: 1}, {}]"), "1:22: many lacks the key \"width_m\": how wide");
}

TEST(Fields, DescribeThemselves) {
  const Schema schema = schema_of<Example>();
  const auto field = [&](const std::string& key) {
    for (const FieldSpec& f : schema.fields) {
      if (f.key == key) return f;
    }
    return FieldSpec{};
  };
  EXPECT_EQ(field("speed_mps").unit, "m/s");
  EXPECT_EQ(field("speed_mps").default_text, "0.4");
  EXPECT_EQ(field("turn_deg").default_text, "15") << "degrees, without the noise of the conversion";
  EXPECT_EQ(field("gait").default_text, "trot");
  EXPECT_EQ(field("at_m").default_text, "[1, 2]");
  EXPECT_EQ(field("inner").fields.at(1).key, "count");
}

TEST(Fields, TheDefaultOfAGroupIsThatOfTheStructAroundIt) {
  const std::vector<FieldSpec> fields = schema_of<Outer>().fields;
  const auto loaded = load_config<Outer>(parse_config_text("middle: {}", "m.yaml"), "outer");
  const auto expect_as_listed = [](const std::vector<FieldSpec>& inner, const Inner& value) {
    EXPECT_EQ(inner.at(0).default_text, config_detail::number_text(value.width_m));
    EXPECT_EQ(inner.at(1).default_text, std::to_string(value.count));
  };
  expect_as_listed(fields.at(0).fields, loaded.inner);
  expect_as_listed(fields.at(1).fields.at(0).fields, loaded.middle.inner);
  expect_as_listed(fields.at(2).fields.at(0).fields, loaded.plain.inner);
  expect_as_listed(fields.at(3).fields, Inner{});
  EXPECT_EQ(loaded.middle.inner.count, 8);
  EXPECT_EQ(loaded.plain.inner.count, 4);
}

std::vector<std::string> load_errors(const std::string& text) {
  try {
    (void)load(text);
  } catch (const ConfigError& error) {
    std::vector<std::string> sentences;
    for (const ConfigError& one : each_of(error)) sentences.push_back(one.what());
    return sentences;
  }
  return {};
}

TEST(Fields, MistakesThatDoNotDependOnEachOtherAreReportedTogether) {
  const std::vector<std::string> errors = load_errors(
      "cells: 0\nloudd: true\nspeedd_mps: 1\nmany: [{width_m: 3}, {width_m: 1}, {cont: 1}]\n"
      "inner: {count: 0}\nat_m: [1, 2]\n");
  EXPECT_EQ(errors,
            (std::vector<std::string>{
                "/c/e.yaml:1:8: cells must be a whole number from 1 to 100, found \"0\"",
                "/c/e.yaml:2:1: unknown key \"loudd\" in example (did you mean \"loud\"?); known: speed_mps, "
                "limit_m, turn_deg, cells, seed, small, loud, name, gait, gaits, file, at_m, corners_m, weights, "
                "inner, extra, many, planner, rest",
                "/c/e.yaml:3:1: unknown key \"speedd_mps\" in example (did you mean \"speed_mps\"?)",
                "/c/e.yaml:4:18: width_m must be a number from 0 to 2 m, found \"3\"",
                "/c/e.yaml:4:37: unknown key \"cont\" in many (did you mean \"count\"?); known: width_m, count",
                "/c/e.yaml:4:36: many lacks the key \"width_m\": how wide",
                "/c/e.yaml:5:16: count must be a whole number from 1 to 10, found \"0\"",
                "/c/e.yaml:5:8: inner lacks the key \"width_m\": how wide"}));
}

TEST(Fields, AfterAHundredMistakesNoMoreAreLookedFor) {
  std::string text;
  for (int i = 0; i < 200; ++i) text += "key_" + std::to_string(i) + ": 1\n";
  EXPECT_EQ(load_errors(text).size(), ConfigErrors::kMax);
}

TEST(Fields, WhatIsRightIsLoadedBesideWhatIsWrong) {
  Example example;
  EXPECT_THROW(schema_of<Example>().load_into(
                   &example, parse_config_text("cells: 0\nspeed_mps: 1\nmany: [1, 9]", "m.yaml"), "example"),
               ConfigError);
  EXPECT_EQ(example.speed_mps, 1.0);
  EXPECT_EQ(example.cells, 5);
}

TEST(Fields, AShorthandThatIsNoFieldIsABug) {
  Schema schema = schema_of<Empty>();
  schema.shorthand = "gone";
  Empty empty;
  EXPECT_THROW(schema.load_into(&empty, parse_config_text("5", "m.yaml"), "empty"), std::logic_error);
}

TEST(NumberText, IsShort) {
  EXPECT_EQ(config_detail::number_text(0.1 + 0.2), "0.3");
  EXPECT_EQ(config_detail::number_text(-0.0), "0");
  EXPECT_EQ(config_detail::number_text(1000000), "1000000");
  EXPECT_EQ(config_detail::number_text(degrees(radians(100.0))), "100");
}

TEST(ExactlyOneOf, RefusesNoneAndSeveral) {
  const auto chosen = [](const char* text) {
    return config_detail::exactly_one_of(parse_config_text(text, "m.yaml"), {"a", "b"}, "a thing");
  };
  EXPECT_EQ(chosen("b: 1"), "b");
  EXPECT_EQ(error_of([&] { (void)chosen("c: 1"); }), "m.yaml:1:1: a thing needs one of a, b");
  EXPECT_EQ(error_of([&] { (void)chosen("b: 1\na: 2"); }),
            "m.yaml:2:1: a thing takes only one of a, b, found both \"b\" and \"a\"");
}

struct Renamed {
  double length_m = 1.0;
  static void describe(Fields<Renamed>& fields) {
    fields.number("length_m", &Renamed::length_m, {0.0, 10.0}, "m", "how long");
    fields.moved("width_m", "`frame.width_m`");
  }
};

TEST(Fields, AKeyThatHasMovedSaysWhereItIsNow) {
  EXPECT_EQ(error_of([] { (void)load_config<Renamed>(parse_config_text("{width_m: 2}", "a.yaml"), "door"); }),
            "a.yaml:1:2: the key \"width_m\" in door is now `frame.width_m`");
}

}  // namespace
}  // namespace cairn
