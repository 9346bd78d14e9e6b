// `cairn template`: what it says about a set of templates, and a template cut out of a map.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string config(const std::string& path) {
  return source_folder() + "/config/" + path;
}

Finished check(const std::filesystem::path& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"template", "check", folder.string(), "--robot", config("robots/pioneer1.yaml")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_cairn(arguments);
}

TEST(TemplateList, SaysWhatEachFileIs) {
  const Finished finished = run_cairn({"template", "list", config("templates_extra"), "--json"});
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
  std::map<std::string, std::string> outline_of;
  const json report = json::parse(finished.out);
  for (const json& one : report["templates"]) {
    outline_of[one["category"]] = one["outline"];
    EXPECT_TRUE(std::filesystem::exists(one["file"].get<std::string>())) << one;
    EXPECT_GT(one["diameter_m"], 0.1);
  }
  EXPECT_EQ(outline_of["bench"], "parts");
  EXPECT_EQ(outline_of["box"], "polygon");
  EXPECT_THAT(run_cairn({"template", "list", config("templates")}).out,
              AllOf(HasSubstr("circle           circle    diameter 0.50 m, 1 orientation at 15 degree steps\n"),
                    HasSubstr("square           polygon ")));
}

TEST(TemplatePreview, DrawsEveryTemplate) {
  const auto folder = fresh_folder("template_preview");
  const std::vector<std::string> command{"template",
                                         "preview",
                                         config("templates"),
                                         "--rendering",
                                         "ideal",
                                         "--json",
                                         "-o",
                                         (folder / "sheet.png").string()};
  const Finished finished = run_cairn(command);
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
  EXPECT_EQ(json::parse(finished.out)["templates"], 15) << "one circle, six squares, eight triangles";
  EXPECT_THAT(text_of_file(folder / "sheet.png"), StartsWith("\x89PNG"));
  const Finished unknown = run_cairn({"template", "preview", config("templates"), "--rendering", "sensed"});
  EXPECT_EQ(unknown.exit_status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("template preview: sensed templates need --robot FILE"));
}

TEST(TemplateCheck, DistinguishesThePapersShapes) {
  const Finished finished = check(config("templates"), {"--json"});
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
  const json report = json::parse(finished.out);
  EXPECT_EQ(report["categories"], json({"circle", "square", "triangle"}));
  EXPECT_EQ(report["views"].size(), 30U) << "15 orientations and as many between";
  int within_a_step = 0;
  for (const json& view : report["views"]) {
    EXPECT_EQ(view["found"], view["shown"]) << view;
    within_a_step += static_cast<int>(view["angle_error_deg"] <= 15.0);
  }
  EXPECT_GE(within_a_step, 28);
}

TEST(TemplateCheck, NamesTwinsAndWhatWouldHelp) {
  const auto folder = fresh_folder("template_twins");
  write_text(folder / "a.yaml", "category: pillar\ncircle: {diameter_m: 0.5}\n");
  write_text(folder / "b.yaml", "category: column\ncircle: {diameter_m: 0.51}\n");
  write_text(folder / "c.yaml", "category: box\npolygon_m: [[0, 0], [0.9, 0], [0.9, 0.5], [0, 0.5]]\n");
  const Finished finished = check(folder, {"--json"});
  const json report = json::parse(finished.out);
  // So alike that the margin leaves them unknown or one is taken for the other, and the box is what it is.
  const int twins_right =
      report["confusion"]["pillar"].value("pillar", 0) + report["confusion"]["column"].value("column", 0);
  EXPECT_LT(twins_right, 4) << report["confusion"];
  EXPECT_EQ(report["confusion"]["box"]["box"], 24) << report["confusion"];
  const std::string advice = report["advice"].dump();
  EXPECT_THAT(advice, HasSubstr("their outlines differ by at most 0.01 m, 0.1 cells; leave one of them out"));
  EXPECT_THAT(check(folder).out,
              AnyOf(HasSubstr("- column left open beside pillar "), HasSubstr("- column taken for pillar ")));
}

}  // namespace
}  // namespace cairn::testing_program
