#pragma once

#include "cli/cli_test_case.hpp"

namespace d2b::test {

/// A way through the program; rasters that are odd are sent down all of them.
struct Way {
    const char* name;
    Arguments arguments;
};

inline std::vector<Way> ways() {
    return {{"Thesis", {"-preset", "thesis", "-fl", "5"}},
            {"Buildings", {"-min_area", "4"}},
            {"NoGround", {"-ground", "none", "-min_area", "4"}}};
}

class HostileTest : public CliTest, public ::testing::WithParamInterface<Way> {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "";
    }
    /// Runs the way on a raster; whatever it warns of, it must end well. @return its buildings
    Layer buildings(const std::string& dem, const std::string& out, Arguments more = {}) const {
        Arguments arguments = GetParam().arguments;
        arguments.insert(arguments.end(), more.begin(), more.end());
        arguments.insert(arguments.end(), {"-q", "-overwrite", "--", dem, out});
        const ToolResult result = run(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        Layer found = layer(out, "buildings");
        for (const Record& record : found.records)
            EXPECT_TRUE(record.valid()) << record.wkt();
        return found;
    }
    Layer buildings(const RasterSpec& spec, const Arguments& more = {}) const {
        write(path("dem.tif"), spec);
        return buildings("dem.tif", "out.gpkg", more);
    }
    /// Area of one_block().
    [[nodiscard]] double block_area() const { return thesis() ? 19 * 24 : 20 * 25; }
    /// Detection takes a cell or two off corners, and walls do not give all of that back.
    [[nodiscard]] double slack() const { return thesis() ? 0 : 6; }
    [[nodiscard]] bool thesis() const { return std::string(GetParam().name) == "Thesis"; }
};

/// 60 x 50 points of 1 m, ground 0, and a flat block of 12 in rows 15 to 34 and columns 20 to 44: 20 x 25
/// cells, and 19 x 24 between the centres of their points, which the thesis's preset draws through.
inline RasterSpec one_block(double low = 0, double high = 12) {
    RasterSpec spec = blocks();
    spec.cols = 60;
    spec.rows = 50;
    spec.values.assign(3000, low);
    for (int row = 15; row <= 34; ++row)
        std::fill_n(spec.values.begin() + row * 60 + 20, 25, high);
    return spec;
}

inline std::vector<std::string> wkts(const Layer& layer) {
    std::vector<std::string> texts;
    for (const Record& record : layer.records)
        texts.push_back(record.wkt());
    return texts;
}

inline std::string way_name(const ::testing::TestParamInfo<Way>& info) {
    return info.param.name;
}

}  // namespace d2b::test
