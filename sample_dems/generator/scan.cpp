#include "scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "cell_box.hpp"
#include "pulses.hpp"
#include "random.hpp"

namespace d2b::sample {

namespace {

/// Returns the height at which a pulse first touches a solid: the highest of its middle and four points
/// of its rim.
template <typename Solid>
std::optional<double> first_return(const Solid& solid, const Pulse& pulse, double beam) {
    std::optional<double> highest;
    constexpr std::array<Position, 5> spots{{{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    for (const Position& spot : spots) {
        const auto z = solid.elevation_at({pulse.at.x + beam * spot.x, pulse.at.y + beam * spot.y});
        if (z && (!highest || *z > *highest))
            highest = z;
    }
    return highest;
}

/// Returns the height in a crown that sends the pulse back; none where it passes through to lower things.
std::optional<double> first_return(const Tree& tree, const Pulse& pulse, double /*beam*/) {
    return tree.first_return(pulse.at, pulse.draw);
}

/// Rows that are being scanned, with the highest return of each pulse so far.
struct ScanRows {
    const Grid& grid;
    const Survey& survey;
    std::int32_t first_row;
    std::int32_t rows;
    const PulseRows& sent;
    std::vector<double>& returns;

    template <typename Thing>
    void meet(const Thing& thing) const {
        const CellBox box = cells_of(extent(thing).grown(survey.beam), grid, first_row, rows);
        for (std::int32_t row = box.top; row < box.bottom; ++row) {
            const std::size_t start =
                static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(grid.cols);
            const std::size_t end =
                sent.first[start + static_cast<std::size_t>(std::max(box.left, box.right))];
            for (std::size_t k = sent.first[start + static_cast<std::size_t>(box.left)]; k < end; ++k)
                if (const auto z = first_return(thing, sent.pulses[k], survey.beam))
                    returns[k] = std::max(returns[k], *z);
        }
    }
};

}  // namespace

void scan(const Scene& scene, const Grid& grid, const Survey& survey, std::int32_t first_row,
          std::int32_t rows, std::span<double> metres) {
    const PulseRows sent = pulses_over(grid, survey, hash(scene.seed, 77, 0), first_row, rows);
    std::vector<double> returns(sent.pulses.size());
    for (std::size_t k = 0; k < returns.size(); ++k)
        returns[k] = scene.ground.at(sent.pulses[k].at);
    const ScanRows seen{grid, survey, first_row, rows, sent, returns};
    for (const Building& building : scene.buildings)
        seen.meet(building);
    for (const Tree& tree : scene.trees)
        seen.meet(tree);
    for (const Block& block : scene.blocks)
        seen.meet(block);
    for (std::size_t cell = 0; cell < metres.size(); ++cell) {
        double highest = -std::numeric_limits<double>::infinity();
        for (std::size_t k = sent.first[cell]; k < sent.first[cell + 1]; ++k) {
            const auto draw = static_cast<std::int64_t>(sent.pulses[k].draw);
            highest = std::max(highest, returns[k] + survey.range_noise * normal_at(scene.seed, draw, 1));
        }
        metres[cell] = std::isinf(highest) ? std::numeric_limits<double>::quiet_NaN() : highest;
    }
}

}  // namespace d2b::sample
