#include "read/grid_transform.hpp"

#include <cstddef>
#include <limits>
#include <vector>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "read/raster_crs.hpp"

namespace d2b {

GridTransform::GridTransform(const std::string& name, const DemInfo& raster, const DemInfo& grid) {
    const GdalMessages messages;
    const CrsOwner from = horizontal_crs(raster.crs_wkt);
    const CrsOwner to = horizontal_crs(grid.crs_wkt);
    same_crs_ = !from || !to || OSRIsSame(from.get(), to.get()) != FALSE;
    const CrsOwner none(OSRNewSpatialReference(nullptr));  // because GDAL does not accept null
    transformer_.reset(
        GDALCreateGenImgProjTransformer4(same_crs_ ? none.get() : from.get(), raster.transform.data(),
                                         same_crs_ ? none.get() : to.get(), grid.transform.data(), nullptr));
    if (!transformer_)
        throw InputError("The " + name + " cannot be converted to the coordinate reference system of '" +
                         grid.name + "': " + messages.reason() + "; reproject it with gdalwarp first.");
}

void GridTransform::apply(std::span<Position> positions, bool to_raster) const {
    const GdalMessages quiet;  // failures become NaN instead
    std::vector<double> x;
    std::vector<double> y;
    for (const Position& p : positions) {
        x.push_back(p.x);
        y.push_back(p.y);
    }
    std::vector<double> z(positions.size(), 0.0);
    std::vector<int> done(positions.size(), FALSE);
    GDALGenImgProjTransform(transformer_.get(), to_raster ? TRUE : FALSE, static_cast<int>(positions.size()),
                            x.data(), y.data(), z.data(), done.data());
    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < positions.size(); ++i)
        positions[i] = done[i] != FALSE ? Position{x[i], y[i]} : Position{nowhere, nowhere};
}

}  // namespace d2b
