#include <optional>

#include "core/crs.hpp"
#include "core/units.hpp"
#include "read/aligned_raster.hpp"
#include "read/side_rasters.hpp"

namespace d2b {

namespace {

std::optional<LengthUnit> vertical_unit(const DemInfo& raster) {
    if (auto band = parse_length_unit(raster.band_unit))
        return band;
    return Crs(raster.crs_wkt).vertical_unit();
}

/// What heights are above, by name; "" where it is not known.
std::string height_reference(const std::string& wkt) {
    const CrsOwner crs(wkt.empty() ? nullptr : OSRNewSpatialReference(wkt.c_str()));
    if (!crs)
        return {};
    if (OSRIsCompound(crs.get()) == FALSE)
        return OSRGetAxesCount(crs.get()) == 3 ? "the ellipsoid" : "";
    const char* datum = OSRGetAttrValue(crs.get(), "VERT_DATUM", 0);
    return datum == nullptr ? "" : datum;
}

class TerrainSource final : public DemSource {
  public:
    TerrainSource(const std::string& path, const DemInfo& grid, double dem_metres, Context& context)
        : raster_("terrain", path, grid, Resampling::bilinear, context) {
        if (const auto unit = vertical_unit(raster_.raster()))
            factor_ = unit->metres / dem_metres;
        raster_.warn_of_gaps("there is no ground");
        const std::string here = height_reference(raster_.raster().crs_wkt);
        const std::string dem = height_reference(grid.crs_wkt);
        if (!here.empty() && !dem.empty() && here != dem)
            context.warn("Heights of the " + raster_.name() + " are above " + here + " and those of '" +
                         grid.name + "' above " + dem +
                         "; they are compared as they are, so convert one of them with gdalwarp first.");
    }

    [[nodiscard]] const DemInfo& info() const override { return raster_.info(); }

    void read(std::int32_t first_row, std::int32_t rows, std::span<double> elevations) override {
        raster_.read(first_row, rows, elevations);
        if (factor_ != 1)
            for (double& elevation : elevations)
                elevation *= factor_;
    }

  private:
    AlignedRaster raster_;
    double factor_ = 1;
};

}  // namespace

std::unique_ptr<DemSource> open_terrain(const std::string& path, const DemInfo& grid,
                                        double dem_vertical_metres, Context& context) {
    return std::make_unique<TerrainSource>(path, grid, dem_vertical_metres, context);
}

}  // namespace d2b
