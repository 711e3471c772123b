#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/context.hpp"
#include "core/undeclared_nodata.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "elevations/filter_invalid.hpp"
#include "features/record_builder.hpp"

namespace d2b::features {

/// Counts invalid values in the report, and warns of these and of suspicious ones: the value, the number of
/// cells, and the option that helps.
/// @param valid number of cells with an elevation
/// @param undeclared values that were taken for no data, or are kept
/// @throws InputError if more than half of all values are invalid
void report_suspicious_values(const SuspiciousValues& suspicious, std::int64_t valid,
                              const UndeclaredNodata& undeclared, const DemInfo& info,
                              const ReadOptions& options, Context& context);

/// Collects buildings with implausible heights, and the elevations responsible: higher than any building ever
/// built, or lower than their ground on average.
class ImplausibleHeights {
  public:
    /// @param building a written building
    /// @param footprint its contour of level 1
    void note(const BuildingRecord& building, const ContourRecord& footprint);
    /// Returns sentences, at most one of each kind.
    [[nodiscard]] std::vector<std::string> warnings() const;

  private:
    struct Extreme {
        std::int64_t buildings = 0;
        std::int64_t id = 0;   ///< id of the most extreme one
        double height_m = 0;   ///< height of that building
        double elevation = 0;  ///< elevation responsible for it
        void add(std::int64_t building, double metres, double extreme, bool farther);
    };

    Extreme high_;
    Extreme low_;
};

}  // namespace d2b::features
