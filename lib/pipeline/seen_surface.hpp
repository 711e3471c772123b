#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "elevations/elevation_reader.hpp"

namespace d2b {

/// The elevations of a part of the window in metres, NaN where there is none. Where the reader keeps all of
/// them like that they are its own, which it gets back as they were: that saves a grid and a pass over it.
class SeenSurface {
  public:
    /// @param metres in a vertical unit @throws InputError, Cancelled
    SeenSurface(ElevationReader& reader, const Window& seen, double metres, Executor& threads);
    SeenSurface(const SeenSurface&) = delete;
    SeenSurface& operator=(const SeenSurface&) = delete;
    ~SeenSurface();

    [[nodiscard]] const MetreGrid& elevations() const { return elevations_; }
    /// For who leaves them as they were.
    [[nodiscard]] MetreGrid& elevations() { return elevations_; }
    /// Makes NaN of what has a flag. @param flags of the cells
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
