// d2b_evidence <dsm.tif> <truth.tif>: the evidence of lib/detect for each object of a surface in
// metres, and the share of the object's cells where the other raster, on the same grid, is not 0. Lines of
// CSV.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>

#include <gdal_priv.h>

#include "detect/candidates.hpp"
#include "detect/threshold_scale.hpp"
#include "ground/ground.hpp"

namespace d2b {
namespace {

/// Elevations in metres and how far apart they are.
struct Surface {
    MetreGrid z;
    CellSize cell;
};

Surface read_surface(const char* path) {
    const GDALDatasetUniquePtr dataset(GDALDataset::Open(path, GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
    if (dataset == nullptr)
        throw std::runtime_error(std::string("cannot open ") + path);
    const OGRSpatialReference* const reference = dataset->GetSpatialRef();
    const double metres = reference == nullptr ? 1 : reference->GetLinearUnits();
    std::array<double, 6> transform{};
    dataset->GetGeoTransform(transform.data());
    const int cols = dataset->GetRasterXSize();
    const int rows = dataset->GetRasterYSize();
    Surface surface{MetreGrid(rows, cols, 0), {transform[1] * metres, -transform[5] * metres}};
    GDALRasterBand* const band = dataset->GetRasterBand(1);
    if (band->RasterIO(GF_Read, 0, 0, cols, rows, surface.z.values.data(), cols, rows, GDT_Float32, 0, 0,
                       nullptr) != CE_None)
        throw std::runtime_error(std::string("cannot read ") + path);
    int has_nodata = 0;
    const auto nodata = static_cast<float>(band->GetNoDataValue(&has_nodata));
    if (has_nodata != 0)
        std::replace(surface.z.values.begin(), surface.z.values.end(), nodata,
                     std::numeric_limits<float>::quiet_NaN());
    return surface;
}

/// The objects as the first look of a run with the defaults finds them, see detect_buildings().
detect::Candidates objects_of(const detect::Scene& scene, detect::SceneCells& cells, const Options& options,
                              detect::SurfaceQuality quality, Executor& threads) {
    constexpr double min_area_m2 = 30;
    quality.threshold_scale =
        detect::estimate_threshold_scale(scene, cells, options.detect, min_area_m2, quality, threads);
    return detect::find_candidates(scene, cells, min_area_m2, quality, threads);
}

/// Cells of an object.
struct Agreement {
    double known = 0;  ///< where the truth is known
    double right = 0;  ///< of these: where it has a building
};

/// Agreement by label - 1.
std::vector<Agreement> compare(const detect::Candidates& judged, const MetreGrid& truth) {
    std::vector<Agreement> result(judged.objects.size());
    for (std::int32_t r = 0; r < judged.regions.rows; ++r)
        for (const RegionRun& run : judged.regions.row(r))
            for (std::int32_t c = run.begin; c < run.end; ++c) {
                result[run.label - 1].known += std::isnan(truth.at(r, c)) ? 0 : 1;
                result[run.label - 1].right += truth.at(r, c) > 0 ? 1 : 0;
            }
    return result;
}

void print_evidence(const char* surface_path, const char* truth_path) {
    Surface surface = read_surface(surface_path);
    const Surface truth = read_surface(truth_path);
    if (truth.z.rows != surface.z.rows || truth.z.cols != surface.z.cols)
        throw std::runtime_error("the two rasters differ in size");
    Context context;
    const Options options;
    const ground::Terrain terrain = ground::estimate_ground(surface.z, surface.cell, options.ground, context);
    for (std::size_t i = 0; i < surface.z.values.size(); ++i)
        if ((terrain.flags.values[i] & ground::low_outlier) != 0)
            surface.z.values[i] = std::numeric_limits<float>::quiet_NaN();
    const detect::Scene scene{surface.z, terrain.elevation, surface.cell};
    detect::SceneCells known = detect::scene_cells(scene, options.detect, *context.threads);
    const detect::SurfaceQuality quality = detect::surface_quality(scene, known, *context.threads);
    const detect::Candidates judged = objects_of(scene, known, options, quality, *context.threads);
    const std::vector<Agreement> agreement = compare(judged, truth.z);
    std::cout << "right,known,cells,cell_m,smooth,step_m,tilt,segment,walled,fall,"
                 "beside_m,right_angles,area_m2,gentle,compactness,filled,confidence\n";
    for (std::size_t i = 0; i < judged.objects.size(); ++i) {
        const detect::ObjectFeatures& e = judged.features[i];
        const auto cells = static_cast<double>(judged.objects[i].cells);
        std::cout << agreement[i].right / std::max(agreement[i].known, 1.0) << ','
                  << agreement[i].known / cells << ',' << cells << ',' << scene.side() << ',' << e.smooth
                  << ',' << e.step_m << ',' << e.tilt << ',' << e.segment << ',' << e.walled << ',' << e.fall
                  << ',' << e.beside_m << ',' << e.right_angles << ',' << e.area_m2 << ','
                  << e.low_slope_ratio << ',' << e.compactness << ',' << quality.filled << ','
                  << judged.objects[i].confidence << '\n';
    }
}

}  // namespace
}  // namespace d2b

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "Usage: d2b_evidence <dsm.tif> <truth.tif>\n";
        return 2;
    }
    try {
        GDALAllRegister();
        d2b::print_evidence(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::cerr << "d2b_evidence: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
