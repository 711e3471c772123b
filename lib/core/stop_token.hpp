#pragma once

#include <functional>
#include <utility>

#include "dem2buildings/error.hpp"

namespace d2b {

/// Request to end a run. Loops over the cells, rings or arcs of one object check it, because one object may
/// cover the whole raster. A check takes some nanoseconds: cheap enough for every ring or every thousandth
/// vertex.
class StopToken {
  public:
    StopToken() = default;
    /// @param asked called by any thread; empty: never stops
    explicit StopToken(std::function<bool()> asked) : asked_(std::move(asked)) {}

    [[nodiscard]] bool asked() const { return asked_ && asked_(); }
    /// @throws Cancelled
    void check() const {
        if (asked())
            throw Cancelled();
    }

  private:
    std::function<bool()> asked_;
};

}  // namespace d2b
