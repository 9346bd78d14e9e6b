#include "maps/pictures/drawing/chart.hpp"

#include "tests/maps/pictures/picture_fixture.hpp"

namespace cairn {
namespace {

using testing::HasSubstr;

class Charts : public Pictures {};

Chart degrees_chart() {
  return {"Orbit round a square",
          "time (s)",
          "degree",
          {{"square", {{0, 0.1}, {1, 0.5}, {2, kNan}, {3, 0.75}}, SeriesStyle::lines_and_points, {}},
           {"it's a \"circle\"; `date`", {{0, 0.2}, {3, 0.4}}, SeriesStyle::points, {}},
           {"nothing", {}, SeriesStyle::lines, {}}},
          {{"tau_match", 0.6}},
          {}};
}

TEST_F(Charts, HaveAScriptThatCarriesItsDataAndQuotesEveryName) {
  const std::string script = gnuplot_script(degrees_chart());
  EXPECT_THAT(script, HasSubstr("$data0 << END_OF_DATA\n0 0.1\n1 0.5\n\n3 0.75\nEND_OF_DATA\n"));
  EXPECT_THAT(script, HasSubstr("title 'it\u2019s a \"circle\"; `date`'"));
  EXPECT_THAT(script, HasSubstr("0.6 with lines dashtype 2"));
  EXPECT_THAT(script, HasSubstr("$data2 << END_OF_DATA\nNaN NaN\nEND_OF_DATA\n"));
}

// gnuplot runs what stands between backquotes, and system().
TEST_F(Charts, RunNothingThatANameSays) {
  const std::string touched = file("touched").string();
  Chart chart;
  const std::vector<std::string> commands{"`touch " + touched + "`",
                                          "'`touch " + touched + "`",
                                          "' . system('touch " + touched + "') . '",
                                          "a\n!touch " + touched + "\n",
                                          "\\'\nsystem 'touch " + touched + "'\n#",
                                          "@touch",
                                          "\"`touch " + touched + "`\""};
  for (const std::string& command : commands) {
    chart.title += command;
    chart.x_label = chart.y_label = command;
    chart.series = {{command, {{0, 0.2}, {1, 0.3}}, SeriesStyle::points, {}}};
    chart.horizontal_lines = {{command, 0.25}};
    chart.x_names = {command, command + "\\"};
    const ChartOutcome outcome = write_chart(file("names.png"), chart);
    EXPECT_TRUE(outcome.drawn) << command << ": " << outcome.reason;
    EXPECT_FALSE(fs::exists(touched)) << command;
  }
}

TEST_F(Charts, DrawUnevenIntervalsByTheirEnds) {
  Chart chart;
  Series shares{"F1", {{0, 0.9}, {0.1, 0.5}}, SeriesStyle::lines_and_points, {}};
  shares.ends = {{0.7, 0.95}, {0.3, 0.6}};
  Series none{"nothing", {{0, kNan}}, SeriesStyle::lines, {}};
  none.ends = {{0, 0}};
  chart.series = {shares, none};
  chart.of_shares_over_x = true;
  const std::string script = gnuplot_script(chart);
  EXPECT_THAT(script, HasSubstr("$data0 << END_OF_DATA\n0 0.9 0.7 0.95\n0.1 0.5 0.3 0.6\nEND_OF_DATA\n"));
  EXPECT_THAT(script, HasSubstr("using 1:2:3:4 with yerrorlines"));
  EXPECT_THAT(script, HasSubstr("set xrange [0:*]\nset yrange [0:1.01]\n"));
  EXPECT_TRUE(write_chart(file("shares.png"), chart).drawn);
}

TEST_F(Charts, BeginAtZeroWhereNothingIsLess) {
  Chart chart;
  chart.series = {{"error", {{2, 0.5}, {3, 0.52}}, SeriesStyle::lines, {}}};
  EXPECT_THAT(gnuplot_script(chart), HasSubstr("set xrange [0:*]\nset yrange [0:*]\n"));
  EXPECT_TRUE(write_chart(file("error.png"), chart).drawn);
  chart.series[0].points.emplace_back(4, -0.1);
  EXPECT_THAT(gnuplot_script(chart), HasSubstr("set xrange [0:*]\nset offsets"));
  EXPECT_TRUE(write_chart(file("log_loss.png"), chart).drawn);
  chart.series[0].points.emplace_back(-4, 0.1);
  EXPECT_THAT(gnuplot_script(chart), testing::Not(HasSubstr("range [0")));
}

TEST_F(Charts, LogarithmicAxesDoNotBeginAtZero) {
  Chart chart;
  chart.series = {{"time", {{1, 1}, {1000, 50}}, SeriesStyle::lines, {}}};
  chart.log_x = chart.log_y = true;
  EXPECT_THAT(gnuplot_script(chart), testing::Not(HasSubstr("range [0")));
  EXPECT_TRUE(write_chart(file("time.png"), chart).drawn);
}

TEST_F(Charts, NamePlacesAndDrawErrorBarsWhereTheyAreGiven) {
  Chart chart;
  chart.series = {{"muriel", {{0, 0.2}, {1, 0.3}}, SeriesStyle::points, {0.01, 0.02}}};
  chart.x_names = {"office", "hall's"};
  const std::string script = gnuplot_script(chart);
  EXPECT_THAT(script, HasSubstr("0 0.2 0.01\n1 0.3 0.02\n"));
  EXPECT_THAT(script, HasSubstr("using 1:2:3 with yerrorbars"));
  EXPECT_THAT(script, HasSubstr("('office' 0, 'hall\u2019s' 1)"));
  EXPECT_TRUE(write_chart(file("bars.png"), chart).drawn);
}

TEST_F(Charts, OfSharesReachFromZeroToOne) {
  Chart chart;
  chart.series = {{"curve", {{0.4, 0.9}, {0.6, 0.8}}, SeriesStyle::lines, {}}};
  chart.of_shares = true;
  EXPECT_THAT(gnuplot_script(chart), HasSubstr("set xrange [0:1.01]\nset yrange [0:1.01]\n"));
  EXPECT_TRUE(write_chart(file("shares.png"), chart).drawn);
}

TEST_F(Charts, AreDrawnAndTheSameEachTime) {
  const ChartOutcome first = write_chart(file("a.png"), degrees_chart());
  ASSERT_TRUE(first.drawn) << first.reason;
  ASSERT_TRUE(write_chart(file("b.png"), degrees_chart()).drawn);
  EXPECT_EQ(bytes_of(file("a.png")), bytes_of(file("b.png")));
  const Png png = read_png(file("a.png"));
  EXPECT_EQ(png.width, 1000);
  EXPECT_GT(png.count({211, 60, 75}), 50) << "the first series' colour";
}

TEST_F(Charts, WithoutDataAreDrawnOrRefusedWithAReason) {
  const ChartOutcome outcome = write_chart(file(), {});
  EXPECT_NE(outcome.drawn, !outcome.reason.empty()) << outcome.reason;
  EXPECT_EQ(outcome.drawn, fs::exists(file()));
}

TEST_F(Charts, SayWhenGnuplotIsMissing) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  const ChartOutcome outcome = write_chart(file(), degrees_chart());
  setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(outcome.drawn);
  EXPECT_EQ(outcome.reason, "gnuplot is not installed, charts need it (package gnuplot-nox)");
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(Charts, SayWhatGnuplotSays) {
  std::ofstream(file("gnuplot")) << "#!/bin/sh\necho 'no terminal' >&2\nexit 1\n";
  fs::permissions(file("gnuplot"), fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder_.string() + ":" + path).c_str(), 1);
  const ChartOutcome outcome = write_chart(file(), degrees_chart());
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(outcome.reason, "gnuplot failed: no terminal");
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(Charts, SayWhenTheFileCannotBeWritten) {
  EXPECT_THAT(write_chart(file("nowhere/chart.png"), degrees_chart()).reason,
              HasSubstr("nowhere/chart.png cannot be written: No such file"));
}

}  // namespace
}  // namespace cairn
