#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "core/crs.hpp"
#include "pipeline/pipeline_case.hpp"

namespace d2b::test {

/// Rows and columns, half open.
struct Box {
    int row = 0;
    int col = 0;
    int rows = 0;
    int cols = 0;

    [[nodiscard]] bool holds(int r, int c) const {
        return r >= row && r < row + rows && c >= col && c < col + cols;
    }
    [[nodiscard]] double area() const { return static_cast<double>(rows) * cols; }
};

/// 140 x 170 cells of 1 m: ground that rises from 100 by 3 cm a column and 1 cm a row, on it a house with a
/// flat roof, one with a gable along its columns, a tower of 25 m on a podium of 9 m, and a wood. Every point
/// is off by a few centimetres, as surveys are.
struct MadeTown {
    static constexpr int rows = 140;
    static constexpr int cols = 170;
    static constexpr Box flat{20, 20, 14, 18};
    static constexpr Box gabled{20, 80, 12, 22};
    static constexpr Box podium{75, 30, 32, 36};
    static constexpr Box tower{84, 40, 12, 14};
    static constexpr Box wood{80, 105, 40, 40};
    static constexpr double flat_height = 7;    ///< above the ground in the middle
    static constexpr double eaves = 5;          ///< likewise
    static constexpr double ridge = 9;          ///< likewise
    static constexpr double podium_height = 9;  ///< likewise
    static constexpr double tower_height = 25;  ///< likewise

    [[nodiscard]] static double ground(double row, double col) { return 100 + 0.03 * col + 0.01 * row; }
    [[nodiscard]] static double middle(const Box& box) {
        return ground(box.row + (box.rows - 1) / 2.0, box.col + (box.cols - 1) / 2.0);
    }
    [[nodiscard]] static std::size_t index(int row, int col) {
        return static_cast<std::size_t>(row) * cols + static_cast<std::size_t>(col);
    }

    /// Height without noise.
    [[nodiscard]] static double roof(int row, int col) {
        if (flat.holds(row, col))
            return middle(flat) + flat_height;
        if (gabled.holds(row, col)) {
            const double from_ridge = std::abs(row - gabled.row - (gabled.rows - 1) / 2.0);
            return middle(gabled) + ridge - (ridge - eaves) * from_ridge / (gabled.rows / 2.0);
        }
        if (tower.holds(row, col))
            return middle(podium) + tower_height;
        if (podium.holds(row, col))
            return middle(podium) + podium_height;
        return std::numeric_limits<double>::quiet_NaN();
    }

    /// The surface. Trees are up to 14 m high and differ by metres from cell to cell.
    [[nodiscard]] static std::vector<double> surface() {
        std::mt19937 random(5);
        const auto share = [&] { return static_cast<double>(random() % 10000) / 10000; };
        std::vector<double> z;
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < cols; ++c) {
                const double noise = 0.06 * (share() - 0.5);
                const double tree = share() < 0.8 ? 14 * share() : 0;
                const double top = roof(r, c);
                z.push_back(noise + (std::isnan(top) ? ground(r, c) + (wood.holds(r, c) ? tree : 0) : top));
            }
        return z;
    }
    /// The same, but the first wall of the flat house runs one row down in four columns: only such a wall has
    /// a staircase.
    [[nodiscard]] static std::vector<double> slanted() {
        std::vector<double> z = surface();
        for (int c = 0; c < flat.cols; ++c)
            for (int r = 0; 4 * r < c; ++r)
                z[index(flat.row + r, flat.col + c)] = ground(flat.row + r, flat.col + c);
        return z;
    }
    /// The surface less the ground.
    [[nodiscard]] static std::vector<double> heights() {
        std::vector<double> z = surface();
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < cols; ++c)
                z[index(r, c)] -= ground(r, c);
        return z;
    }
    /// The ground alone.
    [[nodiscard]] static std::vector<double> terrain() {
        std::vector<double> z;
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < cols; ++c)
                z.push_back(ground(r, c));
        return z;
    }
    /// A value in boxes, another elsewhere.
    [[nodiscard]] static std::vector<double> in(const std::vector<Box>& boxes, double inside,
                                                double outside) {
        std::vector<double> z(static_cast<std::size_t>(rows) * cols, outside);
        for (const Box& box : boxes)
            for (int r = box.row; r < box.row + box.rows; ++r)
                for (int c = box.col; c < box.col + box.cols; ++c)
                    z[index(r, c)] = inside;
        return z;
    }
    /// A source on the town's grid, in plain metres.
    [[nodiscard]] static MemorySource source(std::vector<double> values) {
        return {rows, cols, std::move(values)};
    }
};

/// A run on the town and all that it gives. Sources and options are changed before run().
struct TownRun {
    explicit TownRun(std::vector<double> elevations = MadeTown::surface())
        : dem(MadeTown::source(std::move(elevations))) {}

    MemorySource dem;
    DemSource* terrain = nullptr;
    DemSource* mask = nullptr;
    DemSource* ndvi = nullptr;
    Options options;
    MemorySink sink;
    MemoryRaster ground;
    MemoryRaster height;
    MemoryRaster canopy;
    Callbacks callbacks;
    RunReport report;

    void run() {
        report = d2b::run(options, {dem, terrain, mask, ndvi}, {sink, &ground, &height, &canopy}, callbacks);
    }
    [[nodiscard]] std::size_t count(std::size_t layer = buildings) const {
        return sink.features[layer].size();
    }

    /// Which feature of a layer covers most of a box; its share of their union is at least `least`.
    std::size_t at(const Box& box, std::size_t layer = buildings, double least = 0.9) const;
};

/// The share of a box in its union with a polygon, by the middles of cells. Unrotated grids with y up.
[[nodiscard]] double overlap(const Feature& feature, const Box& box, const AffineTransform& transform);

}  // namespace d2b::test
