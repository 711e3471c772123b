#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "dem2buildings/sinks.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// Hillshaded relief of a DEM, lit from the upper left of the map. Takes elevations in metres, all rows of
/// the window, and keeps about one shade per pixel. NaN cells stay white.
class Relief final : public RasterSink {
  public:
    explicit Relief(const MapFrame& frame);
    Relief(const Relief&) = delete;
    Relief& operator=(const Relief&) = delete;
    ~Relief() override;

    /// @param rows next rows of the window, in full width
    void write(const Window& rows, std::span<const float> values) override;
    void finish() override {}

    struct Impl;
    [[nodiscard]] const Impl& impl() const { return *impl_; }

  private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b
