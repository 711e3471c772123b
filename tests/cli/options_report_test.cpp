#include <fstream>
#include <regex>
#include <thread>

#include <nlohmann/json.hpp>

#include "cli/option_effect.hpp"
#include "options/option_table.hpp"

namespace d2b::test {
namespace {

using nlohmann::json;

}  // namespace

TEST_F(OptionEffect, q) {
    EXPECT_EQ(trace({}),
              "0...10...20...30...40...50...60...70...80...90...100 - done.\n"
              "2 buildings and 4 contours in out.gpkg (left out: 1 below -nf)\n");
    EXPECT_EQ(trace({"-q", "-overwrite"}), "");
    EXPECT_EQ(trace({"-quiet", "-overwrite"}), "");
    EXPECT_EQ(trace({"--quiet", "--overwrite"}), "");
}

/// A house of 24 x 20 m, of which two fifths are 10 m higher than the rest.
TEST_F(OptionEffect, q__leavesTheAdviceOut) {
    preset_ = "buildings";
    RasterSpec spec = blocks();
    spec.cols = spec.rows = 70;
    spec.values.assign(4900, 0.0);
    fill(spec, 20, 39, 20, 43, 9);
    fill(spec, 20, 27, 20, 43, 19);
    write(path("step.tif"), spec);
    const std::string advice =
        "1 of 1 building (100 % of their area) differs by more than 5 m inside: "
        "-split_height 3 divides it.\n";
    EXPECT_TRUE(run_well({"step.tif", "out.gpkg"}).ends_with(advice));
    EXPECT_EQ(run_well({"-q", "-overwrite", "step.tif", "out.gpkg"}), "");
    const std::string divided = run_well({"-overwrite", "-split_height", "3", "step.tif", "out.gpkg"});
    expect_has(divided, "2 buildings and");
    EXPECT_EQ(divided.find("-split_height"), std::string::npos);
}

TEST_F(OptionEffect, json) {
    const json report = json::parse(trace({"-json", "-nf", "11"}));
    EXPECT_EQ(report["input"]["name"], "blocks.tif");
    EXPECT_EQ(report["input"]["driver"], "GTiff");
    EXPECT_EQ(report["input"]["points"], 600);
    EXPECT_EQ(report["input"]["maximum"], 20);
    EXPECT_NEAR(report["input"]["mean"].get<double>(), 1.84, 1e-12);
    EXPECT_EQ(report["units"]["vertical_source"], "horizontal unit of the CRS");
    EXPECT_EQ(report["units"]["areas"], "geodesic");
    ASSERT_EQ(report["levels"].size(), 3U);
    EXPECT_EQ(report["levels"][2]["threshold"], 15);
    EXPECT_EQ(report["levels"][2]["points"], 20);
    EXPECT_EQ(report["output"]["name"], "out.gpkg");
    EXPECT_EQ(report["output"]["buildings"], 1);
    EXPECT_EQ(report["output"]["contours"], 3);
    EXPECT_EQ(report["output"]["vertices"], 12);
    EXPECT_EQ(report["dropped"]["contour_short"], 2);
    EXPECT_GT(report["stages"]["write"]["seconds"].get<double>(), 0);
    EXPECT_TRUE(report["warnings"].empty());
}

TEST_F(OptionEffect, sweep) {
    preset_ = "buildings";
    const std::string town = sample("town.tif");
    const std::vector<std::string> part{"-te", "391250", "5820250", "391650", "5820600"};
    Arguments all{"-json", "-sweep", "lod=2..4..2,nf=5..40..35,detail=0..1", "-preview", "sheet.png"};
    all.insert(all.end(), part.begin(), part.end());
    all.push_back(town);
    const json trials = json::parse(run_well(all))["trials"];
    EXPECT_EQ(entries(), (std::vector<std::string>{"blocks.tif", "sheet.png"}));
    ASSERT_EQ(trials.size(), 8U);
    for (const json& trial : trials) {
        Arguments one{"-json", "-overwrite",       "-lod",    trial["lod"].dump(),
                      "-nf",   trial["nf"].dump(), "-detail", trial["detail"].dump()};
        one.insert(one.end(), part.begin(), part.end());
        one.insert(one.end(), {town, "one.gpkg"});
        const json output = json::parse(run_well(one))["output"];
        EXPECT_EQ(trial["buildings"], output["buildings"]);
        EXPECT_EQ(trial["contours"], output["contours"]);
        EXPECT_EQ(trial["points"], output["vertices"]);
        EXPECT_EQ(trial["stack_rmse_m"], output["stack_rmse_m"]);
    }
    EXPECT_LT(trials[0]["contours"], trials[4]["contours"]);  // more levels
    EXPECT_GT(trials[0]["points"], trials[1]["points"]);      // cleaner tiers
    EXPECT_GT(trials[0]["contours"], trials[2]["contours"]);  // less noise
    EXPECT_TRUE(trials[0]["same_as_first"]);
    EXPECT_FALSE(trials[1]["same_as_first"]);
    const OpenDataset sheet(GDALOpen(path("sheet.png").c_str(), GA_ReadOnly));
    ASSERT_NE(sheet, nullptr);
    EXPECT_EQ(std::max(GDALGetRasterXSize(sheet.get()), GDALGetRasterYSize(sheet.get())), 1600);
    const std::string table =
        run_well({"-q", "-sweep", "lod=3", "-te", "391250", "5820250", "391350", "5820350", town});
    EXPECT_EQ(std::ranges::count(table, '\n'), 2);
    expect_has(table, "        lod  buildings   contours     points   rmse [m]    seconds\n          3 ");
    expect_error(2, "-sweep takes one file name", {"-sweep", "lod=1..2", town, "out.gpkg"});
}

/// The outlines of the blocks enclose 63 and 6 m2: from 20 m2 on there is one, up to 60 m2.
TEST_F(OptionEffect, sweep__saysWhichValuesChangeNothing) {
    preset_ = "thesis";
    const std::string table = run_well({"-q", "-sweep", "lod=2,min_area=0..60..20", "blocks.tif"});
    const json report = json::parse(run_well({"-json", "-sweep", "lod=2,min_area=0..60..20", "blocks.tif"}));
    const auto& trials = report["trials"];
    ASSERT_EQ(trials.size(), 4U);
    EXPECT_EQ(trials[0]["buildings"], 2);
    for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_EQ(trials[i]["buildings"], 1);
        EXPECT_FALSE(trials[i]["same_as_first"]);
    }
    EXPECT_EQ(report["no_change"], (json{{"min_area", {20, 60}}}));
    expect_has(table, "-min_area from 20 to 60 changes nothing here.\n");
    expect_error(2, "-sweep cannot vary 'threads'", {"-sweep", "threads=1..2", "blocks.tif"});
    expect_error(2, "-sweep cannot vary 'i'", {"-sweep", "i=2..6..2", "blocks.tif"});
    expect_error(2, "-sweep varies 'lod' twice; name it once.", {"-sweep", "lod=1..2,lod=3", "blocks.tif"});
    expect_error(
        2, "-sweep cannot take '60..10' for min_area; give one value, first..last, or first..last..step",
        {"-sweep", "min_area=60..10", "blocks.tif"});
    expect_error(2, "-sweep cannot take '1..2..3..4' for lod;", {"-sweep", "lod=1..2..3..4", "blocks.tif"});
    expect_error(2, "-min_confidence must be a number from 0 to 1, not '1.5'.",
                 {"-sweep", "min_confidence=0.5..1.5..0.5", "blocks.tif"});
}

TEST_F(OptionEffect, sweep__overwritesItsSheet) {
    const Arguments sweep{"-q", "-sweep", "nf=5..10..5", "-preview", "sheet.png", "blocks.tif"};
    run_well(sweep);
    expect_error(2, "sheet.png", sweep);
    Arguments again = sweep;
    again.insert(again.begin(), "-overwrite");
    run_well(again);
}

TEST_F(OptionEffect, threads) {
    preset_ = "buildings";
    const std::string town = sample("town.tif");
    const auto lines = [&](const char* threads, const char* name) {
        const json report =
            json::parse(run_well({"-json", "-threads", threads, "-split_height", "3", "--", town, name}));
        EXPECT_EQ(report["threads"], std::stoi(threads));
        std::string text;
        for (const char* layer_name : {"buildings", "contours"}) {
            const Layer found = layer(name, layer_name);
            for (const Record& record : found.records) {
                for (const std::string& field : found.fields)
                    text += record.text(field) + " ";
                text += record.wkt() + "\n";
            }
        }
        return text;
    };
    const std::string alone = lines("1", "alone.gpkg");
    EXPECT_GT(alone.size(), 100000U);
    EXPECT_EQ(lines("2", "two.gpkg"), alone);
    EXPECT_EQ(lines("7", "seven.gpkg"), alone);
    const json report = json::parse(run_well({"-json", "--", town, "default.gpkg"}));
    EXPECT_EQ(report["threads"], std::thread::hardware_concurrency());
}

TEST_F(OptionEffect, json__warnings) {
    RasterSpec spec = blocks();
    spec.crs = "";
    write(path("plain.tif"), spec);
    const json report = json::parse(
        run_warned({"-json", "-fl", "5", "--", "plain.tif", "out.gpkg"}, {"no coordinate reference system"}));
    ASSERT_EQ(report["warnings"].size(), 1U);
    expect_has(report["warnings"][0], "no coordinate reference system");
    EXPECT_EQ(report["units"]["areas"], "planar");
}

TEST_F(OptionEffect, help) {
    for (const char* name : {"--help", "-help", "-h"}) {
        const std::string text = run_well({name});
        expect_has(text, "Usage: dem2buildings [options] <src_raster>... <dst_vector>");
        expect_has(text, "-min_area <m2>");
        EXPECT_EQ(text.find("-lod <n>"), std::string::npos);
    }
}

TEST_F(OptionEffect, help_all) {
    for (const char* name : {"--help_all", "--help-all", "-help_all"})
        expect_has(run_well({name}), "-lod <n>");
}

TEST_F(OptionEffect, version) {
    for (const char* name : {"--version", "-version"})
        EXPECT_TRUE(
            std::regex_match(run_well({name}), std::regex("dem2buildings \\d+\\.\\d+\\.\\d+, GDAL \\d.*\n")));
}

TEST_F(OptionEffect, man) {
    const std::string page = run_well({"-man"});
    EXPECT_TRUE(page.starts_with(".TH"));
    expect_has(page, ".SH EXAMPLES");
}

TEST_F(OptionEffect, options_md) {
    const std::string text = run_well({"-options_md"});
    EXPECT_TRUE(text.starts_with("# Options of dem2buildings\n"));
    expect_has(text, "`-lod <n>`");
}

TEST_F(OptionEffect, options_json) {
    const auto json = nlohmann::json::parse(run_well({"-options_json"}));
    ASSERT_EQ(json["options"].size(), option_table().size());
    for (const auto& option : json["options"])
        if (option["name"] == "lod") {
            EXPECT_EQ(option["kind"], "whole");
            EXPECT_EQ(option["lowest"], 1);
            EXPECT_EQ(option["highest"], 10000);
            EXPECT_EQ(option["default"], "4");
            EXPECT_EQ(option["presets"], (nlohmann::json{"buildings", "thesis"}));
            EXPECT_EQ(option["python"],
                      (nlohmann::json{{"name", "lod"}, {"extract", true}, {"extract_file", true}}));
        } else if (option["name"] == "ground") {
            EXPECT_EQ(option["kind"], "terrain");
            EXPECT_EQ(option["choices"], (nlohmann::json{"auto", "none"}));
            EXPECT_EQ(option["presets"], nlohmann::json::array({"buildings"}));
        } else if (option["name"] == "f") {
            EXPECT_EQ(option["aliases"], (nlohmann::json{"of", "output_format"}));
            EXPECT_FALSE(option["python"]["extract"]);
        }
}

TEST_F(OptionEffect, bash_completion) {
    std::ofstream(path("complete.sh")) << run_well({"-bash_completion"});
    const std::string ask =
        ". ./complete.sh; COMP_WORDS=(dem2buildings $0 \"$1\"); COMP_CWORD=2; "
        "_dem2buildings; echo ${COMPREPLY[*]}";
    const auto completed = [&](const std::string& before, const std::string& word) {
        return run_tool({"/bin/bash", "-c", ask, before, word}, {.working_directory = folder_.string()}).out;
    };
    EXPECT_EQ(completed("-preset", "th"), "thesis\n");
    EXPECT_EQ(completed("-q", "-max"), "-max_building_width\n");
    EXPECT_EQ(completed("-q", "comp"), "complete.sh\n");
    EXPECT_EQ(completed("-lod", ""), "\n");
}

}  // namespace d2b::test
