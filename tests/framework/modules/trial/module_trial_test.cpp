#include "framework/modules/trial/module_trial.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(ModuleTrial, AnOutcomeReadsBackAsItWasWritten) {
  TrialOutcome outcome;
  outcome.fault = "two\nlines, a \\ and \\n";
  outcome.is_fatal = true;
  outcome.modules = {{PluginKind::sensor, "a b", ""}, {PluginKind::behaviour, "", "kind\nname x\n"}};
  const auto read = outcome_from(text_of(outcome));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->fault, outcome.fault);
  EXPECT_TRUE(read->is_fatal);
  ASSERT_EQ(read->modules.size(), 2U);
  EXPECT_EQ(read->modules[0].kind, PluginKind::sensor);
  EXPECT_EQ(read->modules[0].name, "a b");
  EXPECT_EQ(read->modules[0].summary, "");
  EXPECT_EQ(read->modules[1].kind, PluginKind::behaviour);
  EXPECT_EQ(read->modules[1].summary, "kind\nname x\n");
}

TEST(ModuleTrial, ATextThatIsCutAnywhereIsNoOutcome) {
  TrialOutcome outcome;
  outcome.modules = {{PluginKind::map, "muriel", "a map"}};
  const std::string text = text_of(outcome);
  for (std::size_t size = 0; size < text.size(); ++size) EXPECT_FALSE(outcome_from(text.substr(0, size))) << size;
  EXPECT_TRUE(outcome_from(text));
}

TEST(ModuleTrial, UnknownLinesAreNoOutcome) {
  for (const char* text :
       {"what else\nend\n", "kind no_kind\nend\n", "name of nothing\nend\n", "end\nend\n", "\nend\n"})
    EXPECT_FALSE(outcome_from(text)) << text;
}

}  // namespace
}  // namespace cairn
