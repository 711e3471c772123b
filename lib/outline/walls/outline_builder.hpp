#pragma once

#include <array>
#include <cstdint>

#include "outline/walls/chain_form.hpp"
#include "outline/walls/drawn_chain.hpp"
#include "outline/walls/fit_walls.hpp"

namespace d2b {

/// Assembles an outline from drawn chains, ring by ring, and measures its difference from the trace.
class OutlineBuilder {
  public:
    explicit OutlineBuilder(const WallOptions& options);

    /// Begins a ring; the first one is the exterior. @param traced_area in cells, negative for interior rings
    void begin_ring(std::int64_t traced_area);
    /// Appends a part of a chain that begins at the end of the previous one. @param form of its chain
    /// @param reversed true if the ring runs against its direction
    void add(const DrawnChain& stretch, const ChainForm& form, bool reversed);
    [[nodiscard]] WallOutline finish();

  private:
    enum Kind : std::uint8_t { walls, simplified, traced };
    [[nodiscard]] Kind kind(Form form) const;
    [[nodiscard]] FineRing& ring() {
        return rings_ == 1 ? result_.polygon.exterior : result_.polygon.interiors.back();
    }

    CellShape shape_;
    bool cuts_corners_;
    WallOutline result_;
    std::uint32_t rings_ = 0;
    std::array<double, 3> lengths_{};  // per kind
    std::int64_t traced_ = 0;
};

}  // namespace d2b
