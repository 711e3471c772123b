#include <functional>
#include <sstream>

#include "hostile/hostile_case.hpp"

namespace d2b::test {
namespace {

using Surface = std::function<double(int row, int col)>;

struct Cost {
    double cpu_seconds = 0;
    double peak_bytes = 0;
    double contours = 0;
    double features = 0;
};

/// Costliest surfaces: contours as many as cells, outlines as long as the raster has cells.
class WorstCases : public CliTest {
  protected:
    Cost cost(int side, const Surface& surface, Arguments arguments) const {
        RasterSpec spec = blocks();
        spec.type = GDT_Byte;
        spec.rows = spec.cols = side;
        spec.values.clear();
        for (int row = 0; row < side; ++row)
            for (int col = 0; col < side; ++col)
                spec.values.push_back(surface(row, col));
        write(path("dem.tif"), spec);
        // Uses one thread, because the memory that several keep at the same moment depends on chance.
        arguments.insert(arguments.end(), {"-threads", "1", "-q", "-overwrite", "--", "dem.tif", "out.gpkg"});
        const ToolResult result = run(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        const auto count = [&](const char* layer) {
            return std::stod("0" + sql_value(path("out.gpkg"), std::string("SELECT count(*) FROM ") + layer));
        };
        return {result.cpu_seconds, static_cast<double>(result.peak_bytes), count("contours"),
                count("contours") + count("buildings")};
    }
    /// Four times the side, sixteen times the cells: time that grows with their square would be 256 times as
    /// long.
    void expect_linear(const Surface& surface, const Arguments& arguments, double bytes_a_cell,
                       double bytes_a_contour = 1500) const {
        const Cost small = cost(150, surface, arguments);
        const Cost large = cost(600, surface, arguments);
        EXPECT_LT(large.cpu_seconds, 40 * small.cpu_seconds);
        if (D2B_SANITIZED != 0)
            return;  // their memory is not the program's
        const double cells = 600 * 600 - 150 * 150;
        const double contours = large.contours - small.contours;
        EXPECT_LT(large.peak_bytes - small.peak_bytes,
                  16e6 + bytes_a_cell * cells + bytes_a_contour * contours);
    }
    const Arguments thesis_{"-preset", "thesis", "-trace", "cells", "-nf", "0", "-fl", "5"};
    const Arguments buildings_{"-preset",   "buildings", "-ground",         "none",
                               "-min_area", "0",         "-min_confidence", "0"};
};

double checkerboard(int row, int col) {
    return (row + col) % 2 == 0 ? 0 : 10;
}

/// Teeth that hang on one wall: one outline with two corners a cell.
double comb(int row, int col) {
    return row == 0 || col % 2 == 0 ? 10 : 0;
}

/// Squares one in another, opened in alternate corners: a corridor that turns as often as it can.
double spiral(int row, int col) {
    constexpr int most = 600;
    const int ring = std::min({row, col, most - 1 - row, most - 1 - col});
    const bool gate = row == ring + 1 && col == ring;
    return (ring % 2 == 0) != gate ? 10 : 0;
}

TEST_F(WorstCases, checkerboards) {
    expect_linear(checkerboard, thesis_, 24);
    expect_linear(checkerboard, buildings_, 60);
}

TEST_F(WorstCases, coarseCheckerboards) {
    const Surface coarse = [](int row, int col) { return checkerboard(row / 4, col / 4); };
    expect_linear(coarse, thesis_, 24);
    expect_linear(coarse, buildings_, 100, 8600);  // walls that all touch are fitted together
}

TEST_F(WorstCases, combs) {
    expect_linear(comb, thesis_, 200);
    expect_linear([](int row, int col) { return comb(row / 4, col / 4); }, buildings_, 100);
}

TEST_F(WorstCases, spirals) {
    expect_linear(spiral, thesis_, 200);
    expect_linear([](int row, int col) { return spiral(row / 4, col / 4); }, buildings_, 100);
}

TEST_F(WorstCases, checkerboardHasTheContoursThatItHas) {
    const Cost found = cost(150, checkerboard, thesis_);
    EXPECT_EQ(found.contours, 150 * 150 / 2 + 1);  // each high cell alone, and the root
    EXPECT_EQ(found.features, 150 * 150 + 1);
}

TEST_F(WorstCases, threeThousandLevels) {
    const auto stairs = [](int row, int col) { return std::min({row, col, 149 - row, 149 - col}) * 3.0; };
    std::vector<std::string> levels{"-fl"};
    for (int i = 0; i < 3000; ++i) {
        std::ostringstream text;
        text << i * 0.1;
        levels.push_back(text.str());
    }
    for (const char* preset : {"thesis", "buildings"}) {
        Arguments arguments{"-preset", preset, "-nf", "0", "-trace", "cells", "-ground", "none"};
        if (std::string(preset) == "thesis")
            arguments.resize(arguments.size() - 2);
        arguments.insert(arguments.end(), levels.begin(), levels.end());
        const Cost found = cost(150, stairs, arguments);
        // Heights from 0 to 222: thresholds 0.1 to 221.9 cut, and 0 in addition is not above the minimum.
        EXPECT_GE(found.contours, 2000) << preset;
        EXPECT_LE(found.contours, 2222) << preset;
    }
}

}  // namespace
}  // namespace d2b::test
