#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

namespace d2b::test {

struct CloseSample {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseSample>;

/// A committed or regenerated GeoTIFF, all of it.
struct Raster {
    int cols = 0;
    int rows = 0;
    std::array<double, 6> transform{};
    std::string crs;  ///< authority code
    std::string unit;
    bool has_nodata = false;
    double nodata = 0;
    std::vector<float> z;

    [[nodiscard]] float at(int row, int col) const {
        return z[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
                 static_cast<std::size_t>(col)];
    }
    /// Centre of a cell, in the CRS.
    [[nodiscard]] OGRPoint centre(int row, int col) const;
};
[[nodiscard]] Raster read_raster(const std::string& folder, const std::string& name);

/// A feature of a truth layer.
struct Footprint {
    std::string kind;
    std::string roof;
    std::string unit;
    double ground = 0;
    double eave_h = 0;
    double roof_h = 0;
    double width_m = 0;
    double length_m = 0;
    double area = 0;     ///< in the CRS
    std::string fields;  ///< all of them as text
    std::string wkb;
    std::unique_ptr<OGRPolygon> polygon;

    [[nodiscard]] bool contains(const OGRPoint& p) const;
};
struct TruthLayer {
    std::string name;
    std::string crs;
    std::vector<Footprint> footprints;
};
/// All layers of a GeoPackage.
[[nodiscard]] std::vector<TruthLayer> read_truth(const std::string& folder, const std::string& file);
/// The layer of a sample.
[[nodiscard]] TruthLayer truth_of(const std::string& sample);

}  // namespace d2b::test
