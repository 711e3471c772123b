#pragma once

#include <cstdint>

#include "attributes/records.hpp"
#include "core/context.hpp"

namespace d2b {

/// Warns of buildings whose heights cannot be, with the elevations that make them so: higher than any that
/// was ever built, or lower than their ground on average.
class OddHeights {
  public:
    explicit OddHeights(Context& context) : context_(context) {}

    /// @param building that is written @param footprint its contour of level 1
    void note(const BuildingRecord& building, const ContourRecord& footprint);
    void finish() const;

  private:
    struct Odd {
        std::int64_t buildings = 0;
        std::int64_t id = 0;   ///< of the one that is farthest off
        double height_m = 0;   ///< its own
        double elevation = 0;  ///< that is to blame
        void add(std::int64_t building, double metres, double extreme, bool farther);
    };

    Context& context_;
    Odd high_;
    Odd low_;
};

}  // namespace d2b
