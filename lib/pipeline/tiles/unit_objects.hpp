#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "dem2buildings/spool.hpp"
#include "tiles/found_tile.hpp"

namespace d2b {

/// Object that does not touch a seam, so only its unit contains it.
struct LoneObject {
    SeenObject seen;
    Window box;
    Label label = 0;  ///< label in its unit
};

/// Objects of a unit, divided by the join step.
struct UnitObjects {
    /// Kind of a label: `left_out`, `interior`, or the index of its object among those at seams, plus one.
    using Mark = std::uint32_t;
    static constexpr Mark left_out = 0;
    static constexpr Mark lone = std::numeric_limits<Mark>::max();

    std::vector<Mark> marks;        ///< by label - 1
    std::vector<LoneObject> alone;  ///< sorted by label
    std::vector<Label> at_seams;    ///< labels in ascending order
};

/// Selection rules for objects that do not touch a seam.
struct LoneRules {
    std::int64_t least_cells = 1;  ///< objects with fewer cells are rejected
    bool doubtful = false;         ///< true to keep low-confidence candidates
};
/// @param[in,out] doubtful is increased by the number of low-confidence interior objects with enough cells
[[nodiscard]] UnitObjects divide_objects(const FoundUnit& unit, const LoneRules& rules,
                                         std::int64_t& doubtful);

/// Spools interior objects until all seams are known, because they may not fit in memory.
class LoneObjects {
  public:
    /// @param units number of units
    LoneObjects(std::unique_ptr<Spool> spool, std::size_t units) : spool_(std::move(spool)), kept_(units) {}

    /// @throws OutputError the spool is full
    void put(std::int64_t unit, const UnitObjects& objects);
    [[nodiscard]] std::vector<UnitObjects::Mark> marks(std::int64_t unit) const;
    [[nodiscard]] std::vector<LoneObject> alone(std::int64_t unit) const;

  private:
    struct Kept {
        SpoolEntry marks;
        SpoolEntry alone;
    };
    std::unique_ptr<Spool> spool_;
    std::vector<Kept> kept_;  ///< by unit
};

}  // namespace d2b
