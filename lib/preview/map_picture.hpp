#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "preview/footprint_drawing.hpp"
#include "preview/map_frame.hpp"
#include "preview/relief.hpp"

namespace d2b {

/// What a run found, for the line below its map.
struct PictureCounts {
    std::int64_t number = 0;  ///< of the buildings that are written, or of the contours where these are alone
    bool contours_alone = false;
    std::int64_t points = 0;  ///< of the outlines
    bool stacked = false;     ///< contours were written
    double rmse_m = 0;        ///< of the stack
    bool paler = false;       ///< some colours are, as what has them is not certain
};

/// A map that is drawn and not yet laid out on a page.
struct MapPicture {
    MapFrame frame;
    std::shared_ptr<Relief> relief;  ///< who gives it elevations asks it for warnings in the end
    FootprintDrawing footprints;
    std::string legend;  ///< what the colours say
    PictureCounts counts;
};

/// What paler colours mean, at the end of a line.
inline constexpr const char* less_certain = " · paler: less certain";

/// "1,234 buildings"
[[nodiscard]] std::string found(const PictureCounts& counts);
/// "Source: town.tif", without folders, and the name of its CRS.
[[nodiscard]] std::string source_line(const MapGround& ground);
/// "1 building", "12,345 points"
[[nodiscard]] std::string counted(std::int64_t number, const std::string& one);
/// "0.8 m"
[[nodiscard]] std::string rounded_metres(double metres);

}  // namespace d2b
