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

/// Elevations of the cells around deferred buildings, collected from all tiles and kept in a spool.
class LeftElevations {
  public:
    explicit LeftElevations(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// Adds cells; cells known from several tiles have equal elevations. @throws OutputError the spool is
    /// full
    void add(const LeftCells& cells);
    /// Measures the error of a stack against them. @param window of the stack @throws OutputError
    [[nodiscard]] StackError error(const DrawnStack& stack, const Window& window,
                                   const FixedPoint& fixed) const;

  private:
    /// Block size in rows and columns of the whole raster.
    static constexpr std::int32_t block_rows = 64;
    static constexpr std::int32_t block_cols = 1024;
    std::unique_ptr<Spool> spool_;
    std::map<LatticePoint, std::vector<SpoolEntry>> blocks_;  ///< by first cell
};

}  // namespace d2b
