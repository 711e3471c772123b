#pragma once

#include <memory>
#include <span>
#include <string>

#include "changed_scene.hpp"
#include "render.hpp"
#include "write_raster.hpp"

namespace d2b::sample {

/// A GeoPackage of true footprints; the same bytes for the same content and the same GDAL. Heights and
/// elevations are in the unit of the raster, which field `unit` names; width and length in metres.
class TruthWriter {
  public:
    /// Replaces a file of that name. @throws OutputError
    explicit TruthWriter(std::string path);
    TruthWriter(const TruthWriter&) = delete;
    TruthWriter& operator=(const TruthWriter&) = delete;
    ~TruthWriter();

    /// A layer with one polygon a building. @throws OutputError
    void add_buildings(const std::string& layer, const RasterSpec& raster,
                       std::span<const Building> buildings);
    /// A layer with one polygon for each group of buildings that share walls. @throws OutputError
    void add_dissolved(const std::string& layer, const RasterSpec& raster,
                       std::span<const Building> buildings);
    /// A layer with a PolygonZ for each plane of a roof, whose elevations are in the unit of the raster.
    /// Cones and domes are left out. @throws OutputError
    void add_roofs(const std::string& layer, const RasterSpec& raster, std::span<const Building> buildings);
    /// A layer of plots of land, each with its name in the field `parcel`. @throws OutputError
    void add_parcels(const std::string& layer, const RasterSpec& raster, std::span<const Parcel> parcels);
    /// A layer of all buildings of two moments, with their change: new, gone, raised, lowered or same.
    /// @throws OutputError
    void add_changes(const std::string& layer, const RasterSpec& raster,
                     std::span<const TruthOfChange> changes);
    /// @throws OutputError
    void finish();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b::sample
