#include "maps/base/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <system_error>

namespace cairn {
namespace {

using namespace std::chrono_literals;

ChildEnd run_script(const std::string& script, std::chrono::milliseconds limit = 60s) {
  return run_child({"/bin/sh", "-c", script}, limit);
}

TEST(ChildProcess, GivesTheExitStatusAndWhatTheChildWrote) {
  const ChildEnd end = run_script("echo out; echo err >&2; echo report >&3; exit 3");
  EXPECT_EQ(end.exit_status, 3);
  EXPECT_EQ(end.signal, 0);
  EXPECT_FALSE(end.has_timed_out);
  EXPECT_EQ(end.printed, "out\nerr\n");
  EXPECT_EQ(end.reported, "report\n");
}

TEST(ChildProcess, GivesTheSignalThatEndedTheChild) {
  const ChildEnd end = run_script("kill -SEGV $$");
  EXPECT_EQ(end.signal, SIGSEGV);
  EXPECT_EQ(end.exit_status, -1);
}

TEST(ChildProcess, TheChildReadsNothing) {
  EXPECT_EQ(run_script("cat; echo done").printed, "done\n");
}

TEST(ChildProcess, TheChildHasNoOtherOpenFiles) {
  EXPECT_EQ(run_script("for fd in 4 5 6 7 8 9; do [ -e /proc/$$/fd/$fd ] && echo $fd; done; true").printed, "");
}

TEST(ChildProcess, ALotOfOutputIsReadAndTheBeginningKept) {
  const ChildEnd end = run_script("head -c 3000000 /dev/zero; echo done >&3");
  EXPECT_EQ(end.printed.size(), 1000U);
  EXPECT_EQ(end.reported, "done\n");
}

TEST(ChildProcess, AChildThatHangsIsKilledAtTheTimeLimit) {
  const ChildEnd end = run_script("echo begun; while :; do sleep 1000; done", 300ms);
  EXPECT_TRUE(end.has_timed_out);
  EXPECT_EQ(run_script("exec 1>&- 2>&- 3>&-; sleep 1000", 300ms).signal, SIGKILL) << "its outputs are closed";
}

TEST(ChildProcess, WhatTheChildLeavesBehindIsKilledAndNotWaitedFor) {
  const ChildEnd end = run_script("sleep 1000 & echo $! >&3");
  EXPECT_EQ(end.exit_status, 0);
  EXPECT_FALSE(end.has_timed_out);
  // Killed; it may stay a zombie for a while, where nobody collects those that lost their parent.
  const std::string state = "/proc/" + end.reported.substr(0, end.reported.find('\n')) + "/stat";
  const auto state_now = [&] { return run_script("cut -d' ' -f3 " + state + " 2>/dev/null").printed; };
  const auto is_gone = testing::AnyOf("", "Z\n", "X\n");
  std::string now = state_now();
  for (int i = 0; i < 500 && !testing::Value(now, is_gone); ++i) now = state_now();  // the machine may be busy
  EXPECT_THAT(now, is_gone);
}

TEST(ChildProcess, AProgramThatIsNotThereIsAnError) {
  EXPECT_THROW((void)run_child({"/nowhere/program"}, 1s), std::system_error);
}

}  // namespace
}  // namespace cairn
