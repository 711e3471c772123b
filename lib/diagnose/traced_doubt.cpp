#include "diagnose/traced_doubt.hpp"

#include "diagnose/words.hpp"

namespace d2b {

std::string traced_doubt(const RunReport& report, double cell_size_m) {
    constexpr double most = 0.05;
    constexpr double fine_cell_m = 1.25;
    const double share = report.outlines_m > 0 ? report.kept_traced_m / report.outlines_m : 0;
    if (!(share > most))
        return {};
    const std::string what =
        percent(share) + " of the length of the buildings' outlines stays as the cells make them";
    if (cell_size_m > fine_cell_m)
        return what + ", since walls cannot be told in cells of " + rounded(cell_size_m) +
               " m; use a finer raster, or a larger -regularize_tolerance";
    return what +
           ", where anything else would have left the trace or met a neighbour; -write_rejected shows "
           "which, and a larger -regularize_tolerance may straighten more";
}

}  // namespace d2b
