#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/lattice.hpp"
#include "dem2buildings/spool.hpp"
#include "features/drawn_stack.hpp"
#include "tiles/drawn_tile.hpp"

namespace d2b {

/// Elevations of the cells around buildings that tiles have left over, from all tiles. They wait in a spool.
class LeftElevations {
  public:
    explicit LeftElevations(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// What several tiles know is the same. @throws OutputError the spool has no room
    void add(const LeftCells& cells);
    /// How far a stack is from them. @param window of the stack @throws OutputError
    [[nodiscard]] StackError error(const DrawnStack& stack, const Window& window,
                                   const FixedPoint& fixed) const;

  private:
    /// Cells come together in blocks of so many rows and columns of the whole raster.
    static constexpr std::int32_t block_rows = 64;
    static constexpr std::int32_t block_cols = 1024;
    std::unique_ptr<Spool> spool_;
    std::map<LatticePoint, std::vector<SpoolEntry>> blocks_;  ///< by their first cells
};

}  // namespace d2b
