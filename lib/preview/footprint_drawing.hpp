#pragma once

#include <memory>
#include <span>
#include <vector>

#include "preview/colour.hpp"
#include "preview/map_frame.hpp"
#include "preview/picture_format.hpp"

namespace d2b {

/// Polygons on a map: pixels for PNG, shapes that stay shapes for SVG and PDF. All of it is translucent, but
/// what lies over something else hides it.
class FootprintDrawing {
  public:
    FootprintDrawing(const MapFrame& frame, PictureFormat format);
    FootprintDrawing(FootprintDrawing&&) noexcept;
    FootprintDrawing& operator=(FootprintDrawing&&) noexcept;
    ~FootprintDrawing();

    using Rings = std::span<const std::vector<Spot>>;
    /// What an odd number of the rings goes round, and the rings. @param rings not closed by a repeated spot
    void fill(Rings rings, Colour colour);
    /// The rings alone, fainter.
    void trace(Rings rings);

    struct Impl;
    [[nodiscard]] const Impl& impl() const { return *impl_; }

  private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b
