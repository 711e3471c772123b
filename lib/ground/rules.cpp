#include "ground/rules.hpp"

#include <algorithm>
#include <cmath>

namespace d2b::ground {
namespace {

// Cell sizes in metres up to which the defaults apply, and from which those for coarse cells do. Map cells of
// one metre may be a little larger on the ground.
constexpr double fine_cell = 1.2;
constexpr double coarse_cell = 2;

}  // namespace

Rules rules_for(const CellSize& cell) {
    const double share =
        std::clamp((std::sqrt(cell.area()) - fine_cell) / (coarse_cell - fine_cell), 0.0, 1.0);
    Rules rules;
    const auto go_to = [&](double& value, double where_coarse) { value += share * (where_coarse - value); };
    // Fitted to places with fine cells, resampled to 2 and 2.5 m as scans show them, see docs/accuracy.md.
    go_to(rules.border_reach, 30);
    go_to(rules.small_slope, 0.16);
    go_to(rules.border_share, 1);
    go_to(rules.large_rise, 0.3);
    go_to(rules.wall_share, 0.75);
    go_to(rules.level_share, 0.6);
    go_to(rules.plateau_share, 0.75);
    return rules;
}

}  // namespace d2b::ground
