#include "read/raster_transform.hpp"

#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {

namespace {

/// Returns true if cells have an area: a determinant within the rounding error of its terms counts as zero.
bool invertible(const AffineTransform& g) {
    if (!std::all_of(g.begin(), g.end(), [](double term) { return std::isfinite(term); }))
        return false;
    const double determinant = g[1] * g[5] - g[2] * g[4];
    return std::abs(determinant) > 1e-12 * std::hypot(g[1], g[4]) * std::hypot(g[2], g[5]);
}

}  // namespace

void set_transform(const std::optional<AffineTransform>& transform, const std::string& advice, DemInfo& info,
                   Warnings& warnings) {
    info.georeferenced = transform.has_value();
    info.transform = transform.value_or(DemInfo{}.transform);
    if (!transform)
        warnings.add("'" + info.name +
                     "' has no georeferencing; coordinates are columns and, upwards, rows.");
    else if (!invertible(*transform))
        throw InputError("The transform of '" + info.name + "' (" + numbers_text(*transform, ", ") +
                         ") gives its cells no area; " + advice + ".");
}

void read_transform(GDALDatasetH dataset, DemInfo& info, Warnings& warnings) {
    AffineTransform transform{};
    if (GDALGetGeoTransform(dataset, transform.data()) == CE_None)
        return set_transform(transform, "correct it, for example with gdal_edit.py -a_ullr", info, warnings);
    // Rejects rasters that GDAL can locate only cell by cell, because outlines need a grid.
    const auto has = [&](const char* domain) {
        const CSLConstList items = GDALGetMetadata(dataset, domain);
        return items != nullptr && items[0] != nullptr;
    };
    if (has("RPC"))
        throw InputError("'" + info.name + "' is placed by rational polynomials (RPCs) only; " +
                         "turn it into a regular grid with gdalwarp -rpc first.");
    if (has("GEOLOCATION"))
        throw InputError("'" + info.name + "' is placed by geolocation arrays only; " +
                         "turn it into a regular grid with gdalwarp -geoloc first.");
    if (GDALGetGCPCount(dataset) > 0)
        throw InputError("'" + info.name + "' is placed by ground control points only; " +
                         "turn it into a regular grid with gdalwarp first.");
    set_transform(std::nullopt, "", info, warnings);
}

}  // namespace d2b
