#include "framework/experiments/factors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string kHead = "experiment: recognition\nmissions: [m.yaml]\n";

ExperimentConfig loaded(const std::string& text) {
  const config_test::TestFolder folder;
  return load_experiment(folder.write("e.yaml", text));
}

// From the line on.
std::string error_of(const std::string& text) {
  try {
    (void)loaded(text);
  } catch (const ConfigError& error) {
    const std::string what = error.what();
    return what.substr(what.find("e.yaml:"));
  }
  return "no error";
}

TEST(Factors, MakeAVariantOfEachValue) {
  const ExperimentConfig config = loaded(
      kHead +
      "vary:\n  - {name: size, set: [\"worlds.landmark_scale={}\", \"detector.sizes=[{}, {}]\"], values: [0.5, 2]}\n");
  ASSERT_EQ(config.variants.size(), 2U);
  EXPECT_EQ(config.variants[0].name, "size 0.5");
  EXPECT_EQ(config.variants[0].factor, "size");
  EXPECT_EQ(config.variants[1].value, "2");
  EXPECT_THAT(config.variants[1].overrides, ElementsAre("detector.sizes=[2, 2]"));
  EXPECT_EQ(config.variants[1].worlds->landmark_scale, 2.0);
  EXPECT_EQ(config.vary[0].label, "size");
}

TEST(Factors, StandBesideVariantsThatAreNone) {
  const ExperimentConfig config =
      loaded(kHead + "variants: [{name: plain}]\nvary:\n  - {name: log, set: [\"map.log={}\"], values: [paper]}\n");
  ASSERT_EQ(config.variants.size(), 2U);
  EXPECT_EQ(config.variants[0].factor, "");
  EXPECT_FALSE(config.variants[0].worlds.has_value());
}

TEST(Factors, SortSettingsByWhatTheyAreOf) {
  const ExperimentConfig config = loaded(kHead +
                                         "worlds: {gap_m: 1}\n"
                                         "variants: [{name: v, set: [robot.radius_m=0.3, robot=r.yaml, "
                                         "worlds.max_landmarks=2, specular_ratio=0.4, map.x=1]}]\n");
  const ExperimentVariant& variant = config.variants[0];
  EXPECT_THAT(variant.robot_overrides, ElementsAre("radius_m=0.3"));
  EXPECT_THAT(variant.overrides, ElementsAre("robot=r.yaml", "map.x=1"));
  EXPECT_EQ(variant.specular_ratio, 0.4);
  EXPECT_EQ(variant.worlds->max_landmarks, 2);
  EXPECT_EQ(variant.worlds->gap_m, 1.0) << "what the experiment says otherwise stays";
  EXPECT_EQ(config.worlds.max_landmarks, 6);
}

TEST(Factors, AreRefusedWithTheReason) {
  EXPECT_EQ(error_of(kHead + "vary:\n  - {name: size, set: [map.log=off], values: [1]}\n"),
            "e.yaml:4:5: a factor must say under set which setting takes its value, as KEY={}");
  EXPECT_EQ(error_of(kHead + "vary:\n  - {name: size, set: [\"map.log={}\"], values: []}\n"),
            "e.yaml:4:5: a factor must list its values");
  EXPECT_EQ(error_of("experiment: missions\nmissions: [m.yaml]\nvary:\n  - {name: a, set: [\"b={}\"], values: [1]}\n"),
            "e.yaml:4:3: vary goes with experiment: recognition");
  EXPECT_EQ(error_of(kHead + "vary:\n  - {name: a, set: [\"robot={}\"], values: [a/b]}\n"),
            "e.yaml:4:42: a factor's value names a folder too, and \"a/b\" cannot be one");
}

TEST(YamlOf, ReadsAsTheValueThatItWasMadeOf) {
  const std::string text = "a: 0.5\nb: [1, \"2\", x y, {c: null}]\n\"d: e\": 'say \"so\"'\n";
  const ConfigValue value = parse_config_text(text, "a.yaml");
  const std::string again = yaml_of(value);
  EXPECT_EQ(again, "{\"a\": 0.5, \"b\": [1, \"2\", \"x y\", {\"c\": null}], \"d: e\": \"say \\\"so\\\"\"}");
  EXPECT_EQ(yaml_of(parse_config_text(again, "b.yaml")), again);
  EXPECT_FALSE(parse_config_text(again, "b.yaml").find("a")->quoted);
}

}  // namespace
}  // namespace cairn
