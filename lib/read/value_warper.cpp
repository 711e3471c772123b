#include "read/value_warper.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <cpl_string.h>

#include "core/number_text.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "read/grid_fit.hpp"

namespace d2b {

namespace {

constexpr double most_source_cells = 1 << 22;  // cells of the raster per part
constexpr double tolerance = 1e-3;             // of positions, in cells of the DEM

struct WarpOptionsRelease {
    void operator()(GDALWarpOptions* options) const { GDALDestroyWarpOptions(options); }
};
using OptionsOwner = std::unique_ptr<GDALWarpOptions, WarpOptionsRelease>;

/// Half the width of the bilinear kernel in cells of the raster. A whole number, because it reproduces a
/// sloping plane exactly.
double reach(double cell) {
    return std::max(1.0, std::round(cell));
}

double* allocate(double value) {
    auto* one = static_cast<double*>(CPLMalloc(sizeof(double)));
    *one = value;
    return one;
}

int* allocate(int value) {
    auto* one = static_cast<int*>(CPLMalloc(sizeof(int)));
    *one = value;
    return one;
}

OptionsOwner options_for(GDALDatasetH source, void* transformer, Resampling resampling,
                         const std::array<double, 2>& cell) {
    OptionsOwner options(GDALCreateWarpOptions());
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    options->hSrcDS = source;
    options->nBandCount = 1;
    options->panSrcBands = allocate(1);
    options->panDstBands = allocate(1);
    options->padfSrcNoDataReal = allocate(nan);
    options->padfDstNoDataReal = allocate(nan);
    options->eWorkingDataType = GDT_Float64;
    options->eResampleAlg = resampling == Resampling::nearest ? GRA_NearestNeighbour : GRA_Bilinear;
    options->pfnTransformer = GDALApproxTransform;
    options->pTransformerArg = transformer;
    // Sets the scale explicitly, because GDAL would guess it for each part from its extent, which is wrong at
    // edges and on rotated grids.
    const auto set = [&](const char* key, const std::string& value) {
        options->papszWarpOptions = CSLSetNameValue(options->papszWarpOptions, key, value.c_str());
    };
    set("XSCALE", number_text(1 / reach(cell[0])));
    set("YSCALE", number_text(1 / reach(cell[1])));
    set("SOURCE_EXTRA", number_text(std::max(reach(cell[0]), reach(cell[1])) + 1));
    set("NUM_THREADS", "1");  // GdalMessages hears only its own thread
    return options;
}

/// Depends on the two grids alone, so that all windows use the same parts.
std::int32_t cols_for(const std::array<double, 2>& cell) {
    return static_cast<std::int32_t>(std::clamp(512 / std::max(1.0, cell[0]), 16.0, 512.0));
}

std::int32_t rows_for(const std::array<double, 2>& cell) {
    const double source_cells = cols_for(cell) * std::max(1.0, cell[0]) * std::max(1.0, cell[1]);
    return static_cast<std::int32_t>(std::clamp(most_source_cells / source_cells, 1.0, 1024.0));
}

}  // namespace

ValueWarper::ValueWarper(BandReader& reader, const DemInfo& raster, const DemInfo& grid,
                         GridTransform transform, Resampling resampling, Warnings& warnings)
    : name_(raster.name),
      transform_(std::move(transform)),
      cell_(cell_in_raster(transform_, grid)),
      part_cols_(cols_for(cell_)),
      most_rows_(rows_for(cell_)),
      source_{reader, raster.rows, raster.cols, warnings, nullptr},
      dataset_(value_dataset(source_)),
      operation_(make_operation(resampling, tolerance * std::min(cell_[0], cell_[1]))) {}

ValueWarper::~ValueWarper() = default;

ValueWarper::OperationOwner ValueWarper::make_operation(Resampling resampling, double most_error) {
    const GdalMessages messages;
    approximate_.reset(GDALCreateApproxTransformer(GDALGenImgProjTransform, transform_.handle(), most_error));
    const OptionsOwner options = options_for(dataset_.get(), approximate_.get(), resampling, cell_);
    OperationOwner operation(GDALCreateWarpOperation(options.get()));
    if (!operation)
        throw InputError("'" + name_ + "' cannot be resampled to the grid of the DEM: " + messages.reason() +
                         "; do so with gdalwarp first.");
    return operation;
}

void ValueWarper::read(const Window& wanted, std::span<double> values) {
    const std::int32_t end_row = wanted.end_row();
    const std::int32_t end_col = wanted.end_col();
    for (std::int32_t row = wanted.row; row < end_row; row += most_rows_)
        for (std::int32_t col = wanted.col - wanted.col % part_cols_; col < end_col; col += part_cols_) {
            const Window part{row, col, std::min(most_rows_, end_row - row), part_cols_};
            warp(part);
            const std::int32_t left = std::max(col, wanted.col);
            const std::int32_t right = std::min(col + part_cols_, end_col);
            for (std::int32_t i = 0; i < part.rows; ++i)
                std::copy_n(
                    part_.data() + std::ptrdiff_t{i} * part_cols_ + (left - col), right - left,
                    values.data() + std::ptrdiff_t{row - wanted.row + i} * wanted.cols + (left - wanted.col));
        }
}

bool ValueWarper::elsewhere(const Window& part) const {
    constexpr int steps = 8;
    std::vector<Position> edge;
    for (int i = 0; i <= steps; ++i) {
        const double share = static_cast<double>(i) / steps;
        const double col = part.col + share * part.cols;
        const double row = part.row + share * part.rows;
        edge.insert(edge.end(), {{col, static_cast<double>(part.row)},
                                 {col, static_cast<double>(part.row) + part.rows},
                                 {static_cast<double>(part.col), row},
                                 {static_cast<double>(part.col) + part.cols, row}});
    }
    transform_.to_raster(edge);
    return std::all_of(edge.begin(), edge.end(), [](const Position& p) { return std::isnan(p.x); });
}

void ValueWarper::warp(const Window& part) {
    part_.assign(static_cast<std::size_t>(part.rows) * static_cast<std::size_t>(part.cols),
                 std::numeric_limits<double>::quiet_NaN());
    if (elsewhere(part))
        return;
    const GdalMessages messages;
    source_.failure = nullptr;
    const CPLErr status = GDALWarpRegionToBuffer(operation_.get(), part.col, part.row, part.cols, part.rows,
                                                 part_.data(), GDT_Float64, 0, 0, 0, 0);
    if (source_.failure)
        std::rethrow_exception(source_.failure);
    if (status != CE_None)
        throw InputError("'" + name_ + "' cannot be resampled to the grid of the DEM: " + messages.reason() +
                         "; do so with gdalwarp first.");
    messages.pass_warnings(source_.warnings);
}

}  // namespace d2b
