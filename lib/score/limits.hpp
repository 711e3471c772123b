#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/crs.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/score.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/overlay.hpp"
#include "score/measure.hpp"

namespace d2b::score {

/// Polygons that limit the area measured.
struct Limit {
    std::string name;  ///< name of the dataset
    std::string what;  ///< description for messages
    Crs crs;
    Polygons area;
    Polygons cell = {};  ///< of a raster: one cell in its middle
};

/// All that the request names: the area of interest, then the raster's cells with data.
/// @throws InputError, OptionError as the readers of polygons and rasters
[[nodiscard]] std::vector<Limit> limits_of(const ScoreRequest& request, Warnings& warnings);

/// Place of one side of a comparison.
struct Extent {
    std::string name;  ///< of the dataset
    Crs crs;
    Box box;
};

/// The plane of the raster's CRS, without a raster that of the reference's, and of the found side's if that
/// has none. @throws InputError as measure_plane()
[[nodiscard]] MeasurePlane common_plane(const ScoreRequest& request, std::span<const Limit> limits,
                                        const Extent& found, const Extent& reference, Warnings& warnings);

/// Returns the shorter side of a cell in metres, because an edge along two cells is not short; nothing
/// without a raster.
[[nodiscard]] std::optional<double> cell_size(std::vector<Limit>& limits, const MeasurePlane& plane,
                                              Warnings& warnings);

/// Intersection of all limits, after both sides were brought to the plane; nothing without limits.
/// @throws InputError if the sides, or a side and a limit, lie in different places
[[nodiscard]] std::optional<Polygons> region_of(std::vector<Limit>& limits, const MeasurePlane& plane,
                                                const Extent& found, const Extent& reference,
                                                Overlay& overlay, Warnings& warnings);

}  // namespace d2b::score
