#include "surface/plan_gaps.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {

LatticeGap lattice_gap(double metres, const CellSize& cell) {
    // The distance from the box's side to its centre is the height of the parallelogram.
    const auto steps = [&](double side) {
        return std::max(std::int64_t{1},
                        static_cast<std::int64_t>(std::ceil(metres / (side * cell.sine) * FinePoint::steps)));
    };
    return {steps(cell.down), steps(cell.across)};
}

PlanGaps plan_gaps(const CellSize& cell) {
    return {largest_of(lattice_gap(PlanGaps::pinch_m, cell), PlanGaps{}.pinch),
            lattice_gap(PlanGaps::corner_m, cell), 2};
}

}  // namespace d2b
