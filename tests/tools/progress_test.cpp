#include "dem2buildings/progress.hpp"

#include <csignal>
#include <sstream>

#include <gtest/gtest.h>

#include "dem2buildings/interrupt.hpp"
#include "options/provenance_text.hpp"
#include "support/run_tool.hpp"

namespace d2b::test {
namespace {

TEST(TerminalProgress, looksLikeThatOfGdal) {
    std::ostringstream out;
    {
        TerminalProgress progress(out);
        progress.update(0);
        EXPECT_EQ(out.str(), "0");
        progress.update(0.05);
        EXPECT_EQ(out.str(), "0..");
        progress.update(0.02);  // back is ignored
        EXPECT_EQ(out.str(), "0..");
        progress.update(0.25);
        EXPECT_EQ(out.str(), "0...10...20..");
        progress.update(1);
        progress.update(2);
    }
    EXPECT_EQ(out.str(), "0...10...20...30...40...50...60...70...80...90...100 - done.\n");
}

TEST(TerminalProgress, endsItsLineWhereTheRunStops) {
    std::ostringstream out;
    {
        TerminalProgress progress(out);
        progress.update(0.1);
    }
    EXPECT_EQ(out.str(), "0...10\n");
    std::ostringstream untouched;
    { const TerminalProgress progress(untouched); }
    EXPECT_EQ(untouched.str(), "");
}

/// Found in a terminal: "0...10..Warning: ...".
TEST(TerminalProgress, letsALineIn) {
    std::ostringstream out;
    {
        TerminalProgress progress(out);
        progress.interrupt(true, [&] { out << "first\n"; });
        progress.update(0.15);
        progress.interrupt(true, [&] { out << "second\n"; });
        progress.interrupt(true, [&] { out << "third\n"; });
        progress.update(0.15);
        progress.update(0.225);
    }
    EXPECT_EQ(out.str(), "first\n0...10..\nsecond\nthird\n.20.\n");
    std::ostringstream apart;
    {
        TerminalProgress progress(apart);
        progress.update(0.05);
        progress.interrupt(false, [] {});
        progress.update(1);
        progress.interrupt(true, [] {});
    }
    EXPECT_EQ(apart.str(), "0...10...20...30...40...50...60...70...80...90...100 - done.\n");
}

TEST(Summary, countsWhatTheLayersHold) {
    RunReport report;
    report.buildings = 1234;
    report.contours = 1005678;
    EXPECT_EQ(summary(report, Layers::both, "delft.gpkg"),
              "1,234 buildings and 1,005,678 contours in delft.gpkg\n");
    EXPECT_EQ(summary(report, Layers::buildings, "x"), "1,234 buildings in x\n");
    EXPECT_EQ(summary(report, Layers::contours, "x"), "1,005,678 contours in x\n");
    report.buildings = 1;
    report.contours = 999;
    EXPECT_EQ(summary(report, Layers::both, "x"), "1 building and 999 contours in x\n");
    report.roofs.emplace();
    report.roofs->flat = 2;
    report.roofs->pitched = 1500;
    report.roofs->doubtful = 3;
    EXPECT_EQ(summary(report, Layers::both, "x"), "1 building, 999 contours and 1,505 faces of roofs in x\n");
    EXPECT_EQ(summary(report, Layers::buildings, "x"), "1 building and 1,505 faces of roofs in x\n");
    report.roofs.reset();
    report.buildings = report.contours = 0;
    EXPECT_EQ(summary(report, Layers::both, "x"), "0 buildings and 0 contours in x\n");
}

TEST(Summary, saysWhatOptionsLeftOut) {
    RunReport report;
    report.buildings = 65;
    report.contours = 200;
    report.count(Reason::building_small, 1297);
    EXPECT_EQ(summary(report, Layers::both, "x"),
              "65 buildings and 200 contours in x (left out: 1,297 below -min_area)\n");
    report.count(Reason::building_low, 3);
    report.count(Reason::building_not_tall, 12);
    report.count(Reason::building_doubtful, 7);
    EXPECT_EQ(
        summary(report, Layers::both, "x"),
        "65 buildings and 200 contours in x (left out: 1,297 below -min_area, 3 below -min_height, 12 below "
        "-min_building_height, 7 below -min_confidence)\n");
    report.doubtful = 7;  // written
    report.dropped = {};
    report.count(Reason::building_doubtful, 7);
    EXPECT_EQ(summary(report, Layers::buildings, "x"), "65 buildings in x\n");
    report.dropped = {};
    report.doubtful = 0;
    report.count(Reason::building_excluded, 2);
    report.count(Reason::building_denied, 1);
    EXPECT_EQ(summary(report, Layers::buildings, "x"),
              "65 buildings in x (left out: 1 by -corrections, 2 in -exclude)\n");
    report.dropped = {};
    report.count(Reason::contour_small, 4);
    EXPECT_EQ(summary(report, Layers::contours, "x"), "200 contours in x (left out: 4 below -min_area)\n");
}

TEST(Summary, countsWhatTheReportCounts) {
    for (std::size_t reason = 0; reason < reason_names.size(); ++reason) {
        RunReport report;
        report.dropped[reason] = 4321;
        const std::string text = summary(report, Layers::both, "x");
        EXPECT_NE(text.find(": 4,321 "), std::string::npos) << reason_names[reason] << " in " << text;
    }
    RunReport one;
    one.count(Reason::hole_small, 1);
    one.count(Reason::roof_spike, 1);
    EXPECT_EQ(summary(one, Layers::buildings, "x"),
              "0 buildings in x (filled: 1 hole; not a roof: 1 cell far above all cells around)\n");
    RunReport report;
    report.count(Reason::building_low, 3);
    report.count(Reason::hole_small, 4);
    report.count(Reason::hole_short, 1);
    report.count(Reason::outline_kept_traced, 421);
    report.count(Reason::elevation_outside_range, 12);
    report.count(Reason::elevation_spike, 2);
    EXPECT_EQ(summary(report, Layers::buildings, "x"),
              "0 buildings in x (left out: 3 below -min_height; filled: 5 holes; drawn differently: 421 as "
              "traced; treated as no data: 12 cells outside -zrange, 2 cells far above all cells around)\n");
}

TEST(Advice, namesTheOptionsThatWouldImproveManyBuildings) {
    const Options options;
    RunReport report;
    report.buildings = 96;
    EXPECT_EQ(advice(report, options), "");
    report.uncertain = 23;
    report.uneven = 3;
    report.buildings_m2 = 10000;
    report.uneven_m2 = 900;
    const std::string uncertain =
        "23 of 96 buildings have a confidence below 0.9: -min_confidence 0.9 -write_doubtful writes them "
        "to a separate layer.\n";
    EXPECT_EQ(advice(report, options), uncertain);
    report.uneven = 5;
    EXPECT_EQ(advice(report, options),
              "5 of 96 buildings (9 % of their area) differ by more than 5 m inside: -split_height 3 divides "
              "them.\n" +
                  uncertain);
    report.uncertain = 0;
    report.uneven = 1;
    report.uneven_m2 = 1000;
    EXPECT_EQ(
        advice(report, options),
        "1 of 96 buildings (10 % of their area) differs by more than 5 m inside: -split_height 3 divides "
        "it.\n");
}

TEST(Advice, isNotGivenForLessThanOneInTwenty) {
    RunReport report;
    report.buildings = 1020;
    report.uncertain = 50;
    EXPECT_EQ(advice(report, {}), "");
    report.uncertain = 51;
    EXPECT_EQ(advice(report, {}),
              "51 of 1,020 buildings have a confidence below 0.9: -min_confidence 0.9 -write_doubtful writes "
              "them to a separate layer.\n");
    EXPECT_EQ(advice({}, {}), "");
}

TEST(Advice, namesNoOptionThatIsGivenOrRefused) {
    RunReport report;
    report.buildings = report.uneven = report.uncertain = 10;
    Options options;
    options.detect.split_height = 4;
    EXPECT_TRUE(advice(report, options).starts_with("10 of 10 buildings have a confidence"));
    options.preset = Preset::thesis;
    EXPECT_EQ(advice(report, options), "");
}

TEST(Advice, namesDegreesForAGeoJson) {
    RunReport report;
    report.crs = "ETRS89 / UTM zone 33N";
    report.units.horizontal = "metre";
    Options options;
    options.write.destination = "a.GeoJSON";
    const std::string hint =
        "The GeoJSON has projected coordinates, but most programs expect degrees: -t_srs EPSG:4326 "
        "writes degrees.\n";
    EXPECT_EQ(advice(report, options), hint);
    options.outline.target_crs = "EPSG:25832";
    EXPECT_EQ(advice(report, options), hint);
    options.outline.target_crs = "EPSG:4258";
    EXPECT_EQ(advice(report, options), "");
    options.outline.target_crs.clear();
    report.units.horizontal = "degree";
    EXPECT_EQ(advice(report, options), "");
    report.units.horizontal = "metre";
    report.crs.clear();
    EXPECT_EQ(advice(report, options), "");
    report.crs = "ETRS89 / UTM zone 33N";
    options.write.layer_options = {"RFC7946=YES"};
    EXPECT_EQ(advice(report, options), "");
    options.write.layer_options.clear();
    options.write.destination = "a.json";
    EXPECT_EQ(advice(report, options), "");
    options.write.format = "GEOJSON";
    EXPECT_EQ(advice(report, options), hint);
}

TEST(Interrupt, isSeenAndTheNextOneEndsTheProcess) {
    std::signal(SIGINT, SIG_DFL);
    catch_interrupts();
    EXPECT_FALSE(interrupted());
    std::raise(SIGINT);
    EXPECT_TRUE(interrupted());
    EXPECT_EXIT(std::raise(SIGINT), testing::KilledBySignal(SIGINT), "");
    catch_interrupts();
    EXPECT_FALSE(interrupted());
    std::signal(SIGINT, SIG_DFL);
}

TEST(Interrupt, staysIgnoredWhereItWasIgnored) {
    std::signal(SIGINT, SIG_IGN);
    catch_interrupts();
    std::raise(SIGINT);
    EXPECT_FALSE(interrupted());
    EXPECT_EQ(std::signal(SIGINT, SIG_DFL), SIG_IGN);
}

}  // namespace
}  // namespace d2b::test

namespace d2b {
namespace {

TEST(SpokenDestination, leavesPasswordsOut) {
    EXPECT_EQ(redacted_destination("PG:host=gis dbname=town password=a,b user=me"),
              "PG:host=gis dbname=town password=... user=me");
    EXPECT_EQ(redacted_destination("PG:PASSWORD='my own' dbname=town"), "PG:PASSWORD=... dbname=town");
    EXPECT_EQ(redacted_destination("PG:postgresql://me:secret@gis:5432/town"),
              "PG:postgresql://me:...@gis:5432/town");
}

TEST(SpokenDestination, isTheNameWhereThereIsNone) {
    for (const char* name : {"town.gpkg", "a:b@c.gpkg", "PG:dbname=town", "PG:postgresql://me@gis/town"})
        EXPECT_EQ(redacted_destination(name), name);
}

}  // namespace
}  // namespace d2b

namespace d2b::test {
namespace {

TEST(RunTool, capturesBothStreamsAndTheStatus) {
    const ToolResult result = run_tool({"sh", "-c", "echo out; echo err >&2; exit 3"});
    EXPECT_EQ(result.status, 3);
    EXPECT_EQ(result.out, "out\n");
    EXPECT_EQ(result.err, "err\n");
}

TEST(RunTool, passesArgumentsWithoutAShell) {
    EXPECT_EQ(run_tool({"printf", "%s|", "a b", "$HOME", "*", ""}).out, "a b|$HOME|*||");
}

TEST(RunTool, feedsStdin) {
    const std::string text(300000, 'x');  // more than a pipe holds
    EXPECT_EQ(run_tool({"cat"}, {.stdin_text = text}).out, text);
    EXPECT_EQ(run_tool({"cat"}).out, "");
}

TEST(RunTool, setsEnvironmentAndFolder) {
    const ToolResult result = run_tool({"sh", "-c", "echo $D2B_TEST; pwd; echo ${PATH:+path}"},
                                       {.environment = {"D2B_TEST=value"}, .working_directory = "/"});
    EXPECT_EQ(result.out, "value\n/\npath\n");
    EXPECT_EQ(run_tool({"sh", "-c", "echo $HOME"}, {.environment = {"HOME=/elsewhere"}}).out, "/elsewhere\n");
}

TEST(RunTool, sendsStdoutElsewhere) {
    const ToolResult result = run_tool({"sh", "-c", "echo lost"}, {.stdout_file = "/dev/null"});
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.status, 0);
}

TEST(RunTool, sendsSignals) {
    const Kill soon{.signal = SIGTERM, .after = std::chrono::milliseconds(50)};
    EXPECT_EQ(run_tool({"sleep", "60"}, {.kill = soon}).status, 128 + SIGTERM);
}

TEST(RunTool, saysWhatCannotBeStarted) {
    EXPECT_THROW((void)run_tool({"/nonexistent/program"}), std::runtime_error);
}

}  // namespace
}  // namespace d2b::test
