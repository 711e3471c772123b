#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "attributes/records.hpp"

namespace d2b {

/// Buildings whose heights cannot be, with the elevations that make them so: higher than any that
/// was ever built, or lower than their ground on average.
class OddHeights {
  public:
    /// @param building that is written @param footprint its contour of level 1
    void note(const BuildingRecord& building, const ContourRecord& footprint);
    /// Sentences, at most one of each kind.
    [[nodiscard]] std::vector<std::string> warnings() const;

  private:
    struct Odd {
        std::int64_t buildings = 0;
        std::int64_t id = 0;   ///< of the one that is farthest off
        double height_m = 0;   ///< its own
        double elevation = 0;  ///< that is to blame
        void add(std::int64_t building, double metres, double extreme, bool farther);
    };

    Odd high_;
    Odd low_;
};

}  // namespace d2b
