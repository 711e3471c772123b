#pragma once

#include <functional>
#include <utility>

#include "dem2buildings/error.hpp"

namespace d2b {

/// Whether a run is to end. Loops over the cells, rings or arcs of one object ask, since one object may be
/// all of a raster: some nanoseconds each time, so every ring may, and every thousandth vertex.
class StopRequest {
  public:
    StopRequest() = default;
    /// @param asked by any thread; may be empty: nobody wants an end
    explicit StopRequest(std::function<bool()> asked) : asked_(std::move(asked)) {}

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
