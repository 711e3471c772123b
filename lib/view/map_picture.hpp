#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dem2buildings/sinks.hpp"
#include "view/map_frame.hpp"
#include "write/file_target.hpp"

namespace d2b::view {

/// Polygons on a map: pixels for PNG, vector shapes for SVG and PDF. The drawing as a whole is translucent,
/// but within it, later polygons hide earlier ones.
class FootprintDrawing {
  public:
    FootprintDrawing(const MapFrame& frame, writing::PictureFormat format);
    FootprintDrawing(FootprintDrawing&&) noexcept;
    FootprintDrawing& operator=(FootprintDrawing&&) noexcept;
    ~FootprintDrawing();

    using Rings = std::span<const std::vector<PixelPoint>>;
    /// Fills by the even-odd rule and draws the rings. @param rings without a repeated last point
    void fill(Rings rings, Colour colour);
    /// Draws the rings only, in a fainter colour.
    void stroke(Rings rings);
    /// Draws the rings in the colour of differences. @param missing true for dashed lines
    void mark(Rings rings, bool missing);

    struct Impl;
    [[nodiscard]] const Impl& impl() const { return *impl_; }

  private:
    std::unique_ptr<Impl> impl_;
};

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

/// Results of a run for the line below its map.
struct PictureCounts {
    std::int64_t number = 0;  ///< number of buildings written, or of contours if there are only contours
    bool contours_only = false;
    bool stacked = false;      ///< true if contours were written
    double rmse_m = 0;         ///< RMS error of the stack
    bool paler = false;        ///< true if some colours are lightened for uncertain features
    std::int64_t added = 0;    ///< outlines of the filled layer that the first of several maps does not have
    std::int64_t missing = 0;  ///< outlines of the filled layer that only the first of several maps has
};

/// Finished map before the page layout.
struct MapPicture {
    MapFrame frame;
    std::shared_ptr<Relief> relief;  ///< shared with the source of elevations, which takes its warnings
    FootprintDrawing footprints;
    std::string legend;  ///< meaning of the colours
    PictureCounts counts;
};

/// Explanation of paler colours, appended to a line.
inline constexpr const char* uncertain_note = " · paler: less certain";
/// Explanation of marked outlines.
inline constexpr const char* difference_note = "Blue: not in the first picture; dashed: only there";

/// Returns text such as "12,345".
[[nodiscard]] std::string grouped(std::int64_t number);
/// Returns text such as "1,234 buildings".
[[nodiscard]] std::string count_text(const PictureCounts& counts);
/// Returns text such as "Source: town.tif" without folders, and the name of the CRS.
[[nodiscard]] std::string source_line(const MapArea& area);
/// Returns text such as "1 building" or "12,345 points".
[[nodiscard]] std::string count_noun(std::int64_t number, const std::string& one);
/// Returns text such as "0.8 m".
[[nodiscard]] std::string rounded_metres(double metres);

}  // namespace d2b::view
