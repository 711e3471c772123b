#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "dem2buildings/spool.hpp"
#include "tiles/found_tile.hpp"

namespace d2b {

/// An object that lies at no seam: its unit alone has seen it.
struct LoneObject {
    SeenObject seen;
    Window box;
    Label label = 0;  ///< of its unit
};

/// What a unit has found, in the hands of join.
struct UnitObjects {
    /// What a label of the unit is: `left_out`, `lone`, or the place of its object among those at the seams,
    /// plus one.
    using Mark = std::uint32_t;
    static constexpr Mark left_out = 0;
    static constexpr Mark lone = std::numeric_limits<Mark>::max();

    std::vector<Mark> marks;        ///< by label - 1
    std::vector<LoneObject> alone;  ///< by label
    std::vector<Label> at_seams;    ///< labels, ascending
};

/// What of the objects counts where they lie at no seam.
struct LoneRules {
    std::int64_t least_cells = 1;  ///< what has fewer is left out
    bool doubtful = false;         ///< is kept
};
/// @param[in,out] doubtful counts the lone ones that have enough cells
[[nodiscard]] UnitObjects divide_objects(const FoundUnit& unit, const LoneRules& rules,
                                         std::int64_t& doubtful);

/// Keeps what lies at no seam out of memory until all seams are known.
class LoneObjects {
  public:
    /// @param units that there are
    LoneObjects(std::unique_ptr<Spool> spool, std::size_t units) : spool_(std::move(spool)), kept_(units) {}

    /// @throws OutputError the spool has no room
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
