#include "framework/behaviour_tree/tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "framework/behaviour_tree/tree_text.hpp"

namespace cairn {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

// A folder of files; "main.yaml" is the list of steps.
class MissionTreeFiles : public testing::Test {
 protected:
  MissionTreeFiles()
      : folder_(std::filesystem::path(testing::TempDir()) / ("cairn_mission_tree_" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~MissionTreeFiles() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  [[nodiscard]] MissionTree read(const std::string& steps) const {
    write("main.yaml", steps);
    return read_mission_tree(read_config_file(folder_ / "main.yaml"), folder_ / "main.yaml");
  }
  // Without the folder.
  [[nodiscard]] std::vector<std::string> errors(const std::string& steps) const {
    std::vector<std::string> texts;
    for (const ConfigError& error : read(steps).errors) {
      std::string text = error.what();
      for (std::size_t at = 0; (at = text.find(folder_.string() + "/")) != std::string::npos;)
        text.erase(at, folder_.string().size() + 1);
      texts.push_back(text);
    }
    return texts;
  }
  [[nodiscard]] std::string text(const std::string& steps) const {
    const MissionTree tree = read(steps);
    for (const ConfigError& error : tree.errors) ADD_FAILURE() << error.what();
    return tree_text(tree.steps);
  }

  const std::filesystem::path folder_;
};

TEST_F(MissionTreeFiles, APlainListIsWhatItWas) {
  const MissionTree tree = read("- explore: {at_most_s: 9}\n- wait\n- save: a.cairn\n");
  ASSERT_EQ(tree.steps.size(), 3U);
  EXPECT_EQ(tree.steps[0].name, "explore");
  EXPECT_EQ(tree.steps[0].choice.config.place.line, 1);
  EXPECT_EQ(tree.steps[1].choice.config.kind, ConfigValue::Kind::map);
  EXPECT_EQ(tree.steps[2].choice.config.scalar, "a.cairn");
  EXPECT_EQ(tree.steps[2].path, "3");
  EXPECT_THAT(tree.errors, IsEmpty());
}

TEST_F(MissionTreeFiles, EveryNodeIsReadWithItsSettingsAndPath) {
  EXPECT_EQ(text("- name: both\n"
                 "  parallel:\n"
                 "    succeed_when: any\n"
                 "    do: [wait: 3, {reactive_sequence: [{not: {time_after: 9}}, {explored: {at_least_ratio: 0.5}}]}]\n"
                 "- retry: {times: 3, do: [{timeout: {after_s: 60, do: {goto: nearest square}}}, wait]}\n"
                 "- repeat: {times: forever, do: {force_success: {reactive_fallback: [{at_place: {at_m: [1, 2]}}, "
                 "{landmark_known: L3}]}}}\n"),
            "1        parallel \"both\"        succeed_when: any\n"
            "1/1        wait                 3\n"
            "1/2        reactive_sequence\n"
            "1/2/1        not\n"
            "1/2/1/1        time_after       9\n"
            "1/2/2        explored           at_least_ratio: 0.5\n"
            "2        retry                  times: 3\n"
            "2/1        sequence\n"
            "2/1/1        timeout            after_s: 60\n"
            "2/1/1/1        goto             nearest square\n"
            "2/1/2        wait\n"
            "3        repeat                 times: forever\n"
            "3/1        force_success\n"
            "3/1/1        reactive_fallback\n"
            "3/1/1/1        at_place         at_m: [1, 2]\n"
            "3/1/1/2        landmark_known   L3\n");
  const MissionTree tree =
      read("[{parallel: {succeed_when: 1, fail_when: all, do: [a, b]}}, {retry: {times: 3, do: c}}]");
  EXPECT_EQ(tree.steps[0].succeed_at, 1U);
  EXPECT_EQ(tree.steps[0].fail_at, 2U);
  EXPECT_EQ(tree.steps[1].times, 3);
  EXPECT_EQ(count_nodes(tree.steps), 5U);
  const auto behaviours = behaviours_of(tree.steps);
  ASSERT_EQ(behaviours.size(), 3U);
  EXPECT_EQ(behaviours[2], &tree.steps[1].children[0]);
}

TEST_F(MissionTreeFiles, NameAloneWithSettingsIsTheBehaviourOfThatName) {
  const MissionTree tree = read("- name: {as: sofa}\n- {wait: 1, name: rest}\n");
  ASSERT_EQ(tree.errors.size(), 0U);
  EXPECT_EQ(tree.steps[0].choice.name, "name");
  EXPECT_EQ(tree.steps[0].name, "name");
  EXPECT_EQ(tree.steps[1].choice.name, "wait");
  EXPECT_EQ(tree.steps[1].name, "rest");
}

TEST_F(MissionTreeFiles, WhatIsWrongIsReportedWithItsPlace) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"wait: 1", "main.yaml:1:1: steps: expected a list of at least one step, found a map"},
      {"[]", "main.yaml:1:1: steps: expected a list of at least one step, found an empty list"},
      {"- {wait: 1, save: a}",
       "main.yaml:1:3: a step is one behaviour or node with its settings, such as `goto: "
       "{landmark: nearest square}`, not a map with 2 keys"},
      {"- {name: a}", "not a map with 0 keys"},
      {"- name: ''\n  wait: 1", "main.yaml:1:9: name: a node's name is not empty"},
      {"- [wait]", "main.yaml:1:3: a step is one behaviour or node"},
      {"- sequence", "main.yaml:1:3: sequence needs a list of at least one node, found nothing"},
      {"- fallback: []", "main.yaml:1:13: fallback needs a list of at least one node, found an empty list"},
      {"- fallback: {wait: 1}", "main.yaml:1:13: fallback needs a list of at least one node, found a map"},
      {"- parallel: {succeed_when: all}", "parallel lacks the key \"do\""},
      {"- parallel: {do: wait}", "main.yaml:1:18: parallel needs a list of at least one node, found text"},
      {"- parallel: {suceed_when: all, do: [wait]}",
       "main.yaml:1:14: unknown key \"suceed_when\" in parallel (did you mean \"succeed_when\"?)"},
      {"- parallel: {succeed_when: 3, do: [a, b]}", "main.yaml:1:28: succeed_when: 3 of only 2 children"},
      {"- parallel: {fail_when: 2, do: [a]}", "main.yaml:1:25: fail_when: 2 of only 1 child"},
      {"- parallel: {fail_when: 0, do: [a]}", "main.yaml:1:25: fail_when must be a whole number from 1"},
      {"- parallel: {fail_when: al, do: [a]}",
       "main.yaml:1:25: fail_when must be all, any or a number, found \"al\" (did you mean \"all\"?)"},
      {"- retry: {do: wait}", "main.yaml:1:10: retry lacks the key \"times\""},
      {"- retry: {times: 0, do: wait}", "main.yaml:1:18: times must be a whole number from 1"},
      {"- repeat: {times: for ever, do: wait}",
       "main.yaml:1:19: times must be forever or a number, found \"for ever\" (did you mean \"forever\"?)"},
      {"- repeat: {times: 2}", "repeat lacks the key \"do\""},
      {"- repeat: {times: 2, do: }", "main.yaml:1:3: repeat needs one node, found nothing"},
      {"- repeat: {times: 2, do: []}", "main.yaml:1:26: repeat needs one node, found an empty list"},
      {"- repeat: {times: 2, do: {a: 1, b: 2}}", "main.yaml:1:26: a step is one behaviour or node"},
      {"- timeout: {after_s: 0, do: wait}", "main.yaml:1:22: after_s must be a number from 0.001"},
      {"- timeout: {after_s: -1, do: wait}", "main.yaml:1:22: after_s must be a number from 0.001"},
      {"- timeout: {after_s: soon, do: wait}", "main.yaml:1:22: after_s must be a number from 0.001"},
      {"- not:", "main.yaml:1:3: not needs one node, found nothing"},
      {"- force_success: []", "main.yaml:1:18: force_success needs one node, found an empty list"},
      {"- landmark_known:", "main.yaml:1:3: landmark_known lacks the key \"landmark\""},
      {"- landmark_known: ''", "main.yaml:1:19: landmark_known needs a landmark or category, found an empty text"},
      {"- landmark_known: nearest", "main.yaml:1:19: landmark_known: \"nearest\" names no category"},
      {"- explored: 95",
       "main.yaml:1:13: explored: at_least_ratio must be a number from 0 to 1, found \"95\" (95 % is 0.95)"},
      {"- at_place: {within_m: 1}", "main.yaml:1:3: at_place needs one of landmark, at_m"},
      {"- at_place: {landmark: L1, at_m: [0, 0]}", "at_place takes only one of"},
      {"- battery_above: 30",
       "main.yaml:1:18: battery_above: ratio must be a number from 0 to 1, found \"30\" (30 % is 0.3)"},
      {"- wait: $time", "main.yaml:1:9: unknown parameter \"time\" of the mission itself; it has none"},
  };
  for (const auto& [steps, expected] : cases) {
    const std::vector<std::string> found = errors(steps);
    ASSERT_EQ(found.size(), 1U) << steps;
    EXPECT_THAT(found.front(), HasSubstr(expected)) << steps;
  }
  EXPECT_THAT(errors("- time_before: {s: 3}"),
              ElementsAre(HasSubstr("main.yaml:1:17: unknown key \"s\" in time_before"),
                          HasSubstr("main.yaml:1:16: time_before lacks the key \"time_s\"")));
}

TEST_F(MissionTreeFiles, SeveralErrorsAreReportedAtOnce) {
  EXPECT_THAT(errors("- fallback:\n    - retry: {times: 0, do: wait}\n    - not: []\n- sequence: []\n- wait: $a\n"),
              ElementsAre(HasSubstr("5:9: unknown parameter"), HasSubstr("2:22: times"), HasSubstr("3:12: not needs"),
                          HasSubstr("4:13: sequence needs")));
}

TEST_F(MissionTreeFiles, NodesThatAreNeverReachedAreErrors) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"- repeat: {times: forever, do: wait}\n- save: a",
       "main.yaml:2:3: \"save\" is never reached: \"repeat\" before "
       "it (line 1) never succeeds"},
      {"- fallback:\n    - force_success: a\n    - b",
       "main.yaml:3:7: \"b\" is never reached: \"force_success\" before it (line 2) "
       "never fails"},
      {"- reactive_fallback:\n    - retry: {times: forever, do: a}\n    - b", "3:7: \"b\" is never reached"},
      {"- sequence:\n    - not: {force_success: a}\n    - b", "3:7: \"b\" is never reached"},
      {"- fallback:\n    - not: {repeat: {times: forever, do: {force_success: a}}}\n    - b",
       "3:7: \"b\" is never reached"},
      {"- sequence:\n    - timeout: {after_s: 1, do: {repeat: {times: forever, do: a}}}\n    - b",
       "3:7: \"b\" is never reached"},
      {"- sequence:\n    - parallel: {succeed_when: 2, do: [a, b, {repeat: {times: forever, do: c}}]}\n    - "
       "parallel: [a, {repeat: {times: forever, do: c}}]\n    - name: last\n      wait: 1",
       "main.yaml:5:7: \"last\" is never reached: \"parallel\" before it (line 3) never succeeds"},
  };
  for (const auto& [steps, expected] : cases) {
    const std::vector<std::string> found = errors(steps);
    ASSERT_EQ(found.size(), 1U) << steps;
    EXPECT_THAT(found.front(), HasSubstr(expected)) << steps;
  }
  for (const std::string fine :
       {"[{repeat: {times: forever, do: a}}]", "[{fallback: [{force_success: a}]}]",
        "[{fallback: [{repeat: {times: forever, do: a}}, b]}]", "[{sequence: [{retry: {times: forever, do: a}}, b]}]",
        "[{fallback: [{timeout: {after_s: 1, do: {force_success: a}}}, b]}]"})
    EXPECT_THAT(errors(fine), IsEmpty()) << fine;
}

TEST_F(MissionTreeFiles, ASubMissionIsPutInWithItsParameters) {
  write("visit.yaml",
        "parameters:\n  where:\n  wait_s: 2\n  at: [1, 2]\nsteps:\n  - goto: {landmark: $where, tolerance_m: 0.2}\n"
        "  - wait: $wait_s\n  - drive: [$at]\n  - save: \"$where\"\n");
  EXPECT_EQ(text("- mission: {file: visit.yaml, with: {where: nearest square}}\n- name: again\n  mission: {file: "
                 "visit.yaml, with: {where: L3, wait_s: 5}}\n"),
            "1    mission \"visit\"  file: visit.yaml, with: {where: nearest square}\n"
            "1/1    goto           landmark: nearest square, tolerance_m: 0.2\n"
            "1/2    wait           2\n"
            "1/3    drive          [[1, 2]]\n"
            "1/4    save           \"$where\"\n"
            "2    mission \"again\"  file: visit.yaml, with: {where: L3, wait_s: 5}\n"
            "2/1    goto           landmark: L3, tolerance_m: 0.2\n"
            "2/2    wait           5\n"
            "2/3    drive          [[1, 2]]\n"
            "2/4    save           \"$where\"\n");
}

TEST_F(MissionTreeFiles, ParametersGoThroughSubMissionsToTheFieldThatTheyAreFor) {
  write("outer.yaml",
        "parameters: {patience: }\nsteps:\n  - mission: {file: inner.yaml, with: {after_s: $patience}}\n");
  write("inner.yaml", "parameters: {after_s: 3}\nsteps:\n  - timeout: {after_s: $after_s, do: wait}\n");
  EXPECT_THAT(text("- mission: {file: outer.yaml, with: {patience: 7}}"), HasSubstr("after_s: 7"));
  EXPECT_THAT(errors("- mission:\n    file: outer.yaml\n    with: {patience: soon}"),
              ElementsAre(AllOf(StartsWith("main.yaml:3:22: after_s must be a number from 0.001"),
                                EndsWith("(given as a parameter to inner.yaml:3:5)"))))
      << "reported where the value was written, and where it is used";
  write("short.yaml", "parameters: {share: , to: L1}\nsteps:\n  - explored: $share\n  - goto: $to\n");
  EXPECT_THAT(errors("- mission: {file: short.yaml, with: {share: 90}}"),
              ElementsAre(AllOf(StartsWith("main.yaml:1:45: explored: at_least_ratio must be"),
                                EndsWith("(given as a parameter to short.yaml:3:5)"))));
  const MissionTree tree = read("- mission: {file: short.yaml, with: {share: 0.9, to: L2}}");
  const TreeNode& go = tree.steps[0].children[1];
  EXPECT_EQ(go.place.text(), (folder_ / "short.yaml").string() + ":4:5");
  EXPECT_EQ(go.choice.config.place.text(), (folder_ / "main.yaml").string() + ":1:54");
}

TEST_F(MissionTreeFiles, ParametersThatDoNotFitAreErrors) {
  write("sub.yaml", "parameters: {where: , wait_s: 2}\nsteps:\n  - goto: $where\n  - wait: $wait_s\n");
  write("typo.yaml", "parameters: {where: here}\nsteps:\n  - goto: $wher\n");
  write("names.yaml", "parameters: {a-b: 1}\nsteps: [wait]\n");
  write("empty.yaml", "parameters: {}\nsteps: []\n");
  write("no_map.yaml", "parameters: [a]\nsteps: [wait]\n");
  write("unknown.yaml", "paramters: {}\nsteps: [wait]\n");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"- mission: sub.yaml", "main.yaml:1:3: sub.yaml needs the parameter \"where\": `with: {where: ...}`"},
      {"- mission: {file: sub.yaml, with: {wher: L1}}",
       "main.yaml:1:36: unknown parameter \"wher\" of sub.yaml (did you mean \"where\"?); known: where, wait_s"},
      {"- mission: {file: sub.yaml, with: [L1]}", "main.yaml:1:35: with: expected a map of parameters"},
      {"- mission: names.yaml", "names.yaml:1:14: a parameter's name is letters, digits and _, not \"a-b\""},
      {"- mission: empty.yaml", "empty.yaml:2:8: mission needs a list of at least one node, found an empty list"},
      {"- mission: no_map.yaml", "no_map.yaml:1:13: parameters: expected a map of parameters"},
      {"- mission: unknown.yaml",
       "unknown.yaml:1:1: unknown key \"paramters\" in sub-mission (did you mean "
       "\"parameters\"?)"},
      {"- mission: sup.yaml", "main.yaml:1:3: sup.yaml: no such file (did you mean \"sub.yaml\"?)"},
  };
  for (const auto& [steps, expected] : cases) {
    const std::vector<std::string> found = errors(steps);
    ASSERT_EQ(found.size(), 1U) << steps;
    EXPECT_THAT(found.front(), HasSubstr(expected)) << steps;
  }
  EXPECT_THAT(
      errors("- mission: typo.yaml"),
      ElementsAre(HasSubstr("typo.yaml:3:11: unknown parameter \"wher\" of typo.yaml (did you mean \"where\"?)"),
                  HasSubstr("typo.yaml:1:21: the parameter \"where\" of typo.yaml is used by no step")));
}

// A mission from elsewhere that names /etc/shadow must not show it.
TEST_F(MissionTreeFiles, WhatStandsInAFileElsewhereThatIsNoSubMissionIsNotShown) {
  std::filesystem::create_directories(folder_ / "in");
  const std::string hidden = " (what stands in a file outside the folder of the one that names it is not shown)";
  const std::string no_map = "secret:1:1: a sub-mission must be a map with the key \"steps\", found ";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"root:$6$hush:19000:0:::\ndaemon:*:19000:0:::\n",
       "secret:1:1: no sub-mission: it lacks the key \"steps\"" + hidden},
      {"root:x:0:0:hush:/root\n", no_map + "text"},
      {"[hush]\n", no_map + "a list"},
      {"{a: 1, hush: 2}\n", "secret:1:1: no sub-mission: it lacks the key \"steps\"" + hidden},
      {"hush: 1\nhush: 2\n", "secret:2:1: the key" + hidden},
      {"- !hush 3\n", "secret:1:3: the YAML tag" + hidden},
      {"a: *hush\n", "not valid YAML" + hidden},
      {"a: 1\n  hush: : 2\n", "not valid YAML" + hidden},
      {"a: \"hush\n", "secret:1:4: the quote that is opened here is never closed" + hidden},
      {"a: \x01hush\n", "secret:1:4: a control character" + hidden},
  };
  for (const auto& [content, expected] : cases) {
    write("secret", content);
    write("in/main.yaml", "- mission: ../secret\n");
    const MissionTree tree = read_mission_tree(read_config_file(folder_ / "in/main.yaml"), folder_ / "in/main.yaml");
    ASSERT_EQ(tree.errors.size(), 1U) << content;
    EXPECT_THAT(tree.errors.front().what(), AllOf(HasSubstr(expected), Not(HasSubstr("hush")))) << content;
  }
  std::filesystem::create_symlink("../secret", folder_ / "in/link.yaml");
  write("secret", "hush: 1\n");
  write("in/main.yaml", "- mission: link.yaml\n");
  const MissionTree linked = read_mission_tree(read_config_file(folder_ / "in/main.yaml"), folder_ / "in/main.yaml");
  EXPECT_THAT(linked.errors.at(0).what(), AllOf(HasSubstr("link.yaml:1:1: no sub-mission"), Not(HasSubstr("hush"))));
  write("beside.yaml", "stpes: [wait]\n");
  EXPECT_THAT(errors("- mission: beside.yaml"),
              ElementsAre(HasSubstr("\"stpes\" in sub-mission (did you mean \"steps\"?)"),
                          HasSubstr("sub-mission lacks the key \"steps\"")));
}

TEST_F(MissionTreeFiles, ASubMissionThatRunsItselfIsRefusedWithTheChain) {
  write("a.yaml", "steps:\n  - wait\n  - fallback: [mission: ./b.yaml]\n");
  write("b.yaml", "steps: [mission: ../" + folder_.filename().string() + "/a.yaml]\n");
  write("self.yaml", "steps: [{mission: main.yaml}]\n");
  EXPECT_THAT(errors("- mission: a.yaml"),
              ElementsAre("b.yaml:1:9: a.yaml would run itself: a.yaml -> b.yaml -> a.yaml"));
  EXPECT_THAT(errors("- mission: self.yaml"),
              ElementsAre("self.yaml:1:10: main.yaml would run itself: main.yaml -> self.yaml -> main.yaml"));
  write("twice.yaml", "steps: [wait]\n");
  EXPECT_THAT(errors("- mission: twice.yaml\n- mission: twice.yaml"), IsEmpty()) << "twice is no recursion";
}

// Files that run each other can be as large as no file can.
TEST_F(MissionTreeFiles, WhatGrowsBeyondAllMeasureIsRefused) {
  for (int i = 0; i < 30; ++i) {
    const std::string next = "{mission: s" + std::to_string(i + 1) + ".yaml}";
    write("s" + std::to_string(i) + ".yaml", "steps: [" + next + ", " + next + "]\n");
    const std::string doubled = "{mission: {file: p" + std::to_string(i + 1) + ".yaml, with: {a: [$a, $a]}}}";
    write("p" + std::to_string(i) + ".yaml", "parameters: {a: 1}\nsteps: [" + doubled + "]\n");
  }
  write("s30.yaml", "steps: [wait]\n");
  write("p30.yaml", "parameters: {a: 1}\nsteps: [wait: $a]\n");
  EXPECT_THAT(errors("- mission: s0.yaml").front(), HasSubstr("the mission has more than 10000 nodes"));
  EXPECT_THAT(errors("- mission: p0.yaml").front(), HasSubstr("the mission is too large"));
  for (int i = 0; i < 70; ++i)
    write("d" + std::to_string(i) + ".yaml", "steps: [mission: d" + std::to_string(i + 1) + ".yaml]\n");
  write("d70.yaml", "steps: [wait]\n");
  EXPECT_THAT(errors("- mission: d0.yaml"),
              ElementsAre(AllOf(StartsWith("d"), EndsWith("the nodes are nested deeper than 64 levels"))));
}

}  // namespace
}  // namespace cairn
