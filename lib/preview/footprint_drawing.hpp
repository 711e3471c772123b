#pragma once

#include <memory>
#include <span>
#include <vector>

#include "preview/colour.hpp"
#include "preview/map_frame.hpp"
#include "preview/picture_format.hpp"

namespace d2b {

/// Polygons on a map: pixels for PNG, vector shapes for SVG and PDF. The drawing as a whole is translucent,
/// but within it, later polygons hide earlier ones.
class FootprintDrawing {
  public:
    FootprintDrawing(const MapFrame& frame, PictureFormat format);
    FootprintDrawing(FootprintDrawing&&) noexcept;
    FootprintDrawing& operator=(FootprintDrawing&&) noexcept;
    ~FootprintDrawing();

    using Rings = std::span<const std::vector<Spot>>;
    /// Fills by the even-odd rule and draws the rings. @param rings without a repeated last point
    void fill(Rings rings, Colour colour);
    /// Draws the rings only, in a fainter colour.
    void trace(Rings rings);

    struct Impl;
    [[nodiscard]] const Impl& impl() const { return *impl_; }

  private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b
