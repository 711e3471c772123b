#include "diagnose/scale_doubt.hpp"

#include <cmath>

#include "core/number_text.hpp"

namespace d2b {

std::string coarse_cells_doubt(double cell_m) {
    constexpr double coarsest_cell_m = 3.0;
    if (!(cell_m > coarsest_cell_m))
        return {};
    return "the cells are " + fixed_text(cell_m, 1) +
           " m wide, which is too coarse for single buildings; up to 1 m is best, 2.5 m may do";
}

std::string tolerance_doubt(double tolerance, double cell) {
    constexpr double most_cells = 100;
    const double cells = tolerance / cell;
    if (!(cells > most_cells))
        return {};
    return "-simplify " + number_text(tolerance) + " is " + number_text(std::round(cells)) +
           " cells wide, which leaves little of a building; it is in units of the input's CRS";
}

}  // namespace d2b
