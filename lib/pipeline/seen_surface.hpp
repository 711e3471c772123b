#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "elevations/elevation_reader.hpp"

namespace d2b {

/// Elevations of a part of the window in metres; NaN if there is none.
/// Borrows the reader's grid if that holds all elevations in this form, because this saves a copy and a pass
/// over it. The destructor restores and returns it.
class SeenSurface {
  public:
    /// @param metres per vertical unit @throws InputError, Cancelled
    SeenSurface(ElevationReader& reader, const Window& seen, double metres, Executor& threads);
    SeenSurface(const SeenSurface&) = delete;
    SeenSurface& operator=(const SeenSurface&) = delete;
    ~SeenSurface();

    [[nodiscard]] const MetreGrid& elevations() const { return elevations_; }
    /// Mutable access for callers that undo their changes.
    [[nodiscard]] MetreGrid& elevations() { return elevations_; }
    /// Sets flagged cells to NaN until destruction. @param flags per cell
    void take_out(const Grid<std::uint8_t>& flags, std::uint8_t flag, Executor& threads);

  private:
    struct TakenOut {
        std::size_t cell;
        float elevation;
    };

    ElevationReader& reader_;
    MetreGrid elevations_;
    bool lent_ = false;
    std::vector<TakenOut> taken_out_;
};

}  // namespace d2b
