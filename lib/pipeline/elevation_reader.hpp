#pragma once

#include <functional>
#include <vector>

#include "core/band.hpp"
#include "core/context.hpp"
#include "core/dem_source.hpp"

namespace d2b {

/// Bands of rows of a source, more than once: kept after the first pass where they fit in memory, else read
/// again. Bands lie on the absolute grid: their borders do not depend on the window.
class ElevationReader {
  public:
    /// @param keep_bytes most that is kept
    ElevationReader(DemSource& source, Context& context, std::size_t keep_bytes = std::size_t{512} << 20);

    /// Calls `use` for each band, from the first row to the last. @throws InputError, and what `use` throws
    void for_each(const std::function<void(const ElevationBand&)>& use);

  private:
    DemSource& source_;
    Context& context_;
    bool keep_;
    bool complete_ = false;  ///< all bands are kept
    std::int32_t rows_a_band_;
    std::vector<ElevationBand> kept_;
};

}  // namespace d2b
