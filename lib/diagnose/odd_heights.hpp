#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "attributes/records.hpp"

namespace d2b {

/// Collects buildings with implausible heights, and the elevations responsible: higher than any building ever
/// built, or lower than their ground on average.
class OddHeights {
  public:
    /// @param building a written building
    /// @param footprint its contour of level 1
    void note(const BuildingRecord& building, const ContourRecord& footprint);
    /// Returns sentences, at most one of each kind.
    [[nodiscard]] std::vector<std::string> warnings() const;

  private:
    struct Odd {
        std::int64_t buildings = 0;
        std::int64_t id = 0;   ///< id of the most extreme one
        double height_m = 0;   ///< height of that building
        double elevation = 0;  ///< elevation responsible for it
        void add(std::int64_t building, double metres, double extreme, bool farther);
    };

    Odd high_;
    Odd low_;
};

}  // namespace d2b
