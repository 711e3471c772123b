#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "preview/footprint_drawing.hpp"
#include "preview/map_frame.hpp"
#include "preview/relief.hpp"

namespace d2b {

/// Results of a run for the line below its map.
struct PictureCounts {
    std::int64_t number = 0;  ///< number of buildings written, or of contours if there are only contours
    bool contours_alone = false;
    std::int64_t points = 0;  ///< number of outline vertices
    bool stacked = false;     ///< true if contours were written
    double rmse_m = 0;        ///< RMS error of the stack
    bool paler = false;       ///< true if some colours are lightened for uncertain features
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
inline constexpr const char* less_certain = " · paler: less certain";

/// Returns text such as "1,234 buildings".
[[nodiscard]] std::string found(const PictureCounts& counts);
/// Returns text such as "Source: town.tif" without folders, and the name of the CRS.
[[nodiscard]] std::string source_line(const MapGround& ground);
/// Returns text such as "1 building" or "12,345 points".
[[nodiscard]] std::string counted(std::int64_t number, const std::string& one);
/// Returns text such as "0.8 m".
[[nodiscard]] std::string rounded_metres(double metres);

}  // namespace d2b
