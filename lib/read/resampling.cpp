#include "read/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include <cpl_string.h>
#include <gdal_priv.h>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"

namespace d2b::reading {

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

namespace {

constexpr double same_cell = 1e-3;
constexpr std::int32_t max_samples = 201;  // per row or column

/// Returns centres of evenly spaced cells, including the first and the last.
std::vector<double> sampled(std::int32_t first, std::int32_t count) {
    const std::int32_t n = std::min(count, max_samples);
    std::vector<double> centres;
    for (std::int32_t i = 0; i < n; ++i) {
        const std::int64_t step = n == 1 ? 0 : std::int64_t{i} * (count - 1) / (n - 1);
        centres.push_back(static_cast<double>(first + step) + 0.5);
    }
    return centres;
}

std::vector<Position> cell_centres(const Window& w) {
    const std::vector<double> cols = sampled(w.col, w.cols);
    std::vector<Position> centres;
    for (const double row : sampled(w.row, w.rows))
        for (const double col : cols)
            centres.push_back({col, row});
    return centres;
}

std::size_t count_inside(const std::vector<Position>& positions, const Window& w) {
    const auto inside = [&w](const Position& p) {
        return p.x >= w.col && p.x <= static_cast<double>(w.col) + w.cols && p.y >= w.row &&
               p.y <= static_cast<double>(w.row) + w.rows;
    };
    return static_cast<std::size_t>(std::count_if(positions.begin(), positions.end(), inside));
}

constexpr int block_size = 256;

class ValueBand final : public GDALRasterBand {
  public:
    explicit ValueBand(ValueSource& source) : source_(source) {
        eDataType = GDT_Float64;
        nRasterXSize = source.cols;
        nRasterYSize = source.rows;
        nBlockXSize = std::min(block_size, source.cols);
        nBlockYSize = std::min(block_size, source.rows);
    }

    double GetNoDataValue(int* known = nullptr) override {
        if (known != nullptr)
            *known = TRUE;
        return std::numeric_limits<double>::quiet_NaN();
    }

  protected:
    CPLErr IReadBlock(int block_col, int block_row, void* data) override {
        try {
            read_block(block_col, block_row, static_cast<double*>(data));
            return CE_None;
        } catch (...) {
            source_.failure = std::current_exception();
            CPLError(CE_Failure, CPLE_AppDefined, "Reading has failed");
            return CE_Failure;
        }
    }

  private:
    /// Clips blocks at the right and lower edge, because they extend beyond the raster.
    void read_block(int block_col, int block_row, double* data) {
        Window part{block_row * nBlockYSize, block_col * nBlockXSize, nBlockYSize, nBlockXSize};
        part.rows = std::min(part.rows, source_.rows - part.row);
        part.cols = std::min(part.cols, source_.cols - part.col);
        values_.resize(static_cast<std::size_t>(part.rows) * static_cast<std::size_t>(part.cols));
        source_.reader.read_part(part, values_, source_.warnings);
        for (std::int32_t i = 0; i < part.rows; ++i)
            std::copy_n(values_.data() + static_cast<std::ptrdiff_t>(i) * part.cols, part.cols,
                        data + static_cast<std::ptrdiff_t>(i) * nBlockXSize);
    }

    ValueSource& source_;
    std::vector<double> values_;
};

class ValueDataset final : public GDALDataset {
  public:
    explicit ValueDataset(ValueSource& source) {
        nRasterXSize = source.cols;
        nRasterYSize = source.rows;
        SetBand(1, std::make_unique<ValueBand>(source).release());
    }
};

constexpr double max_source_cells = 1 << 22;  // cells of the raster per part
constexpr double tolerance = 1e-3;            // of positions, in cells of the DEM

using OptionsOwner = GdalOwner<GDALWarpOptions*, GDALDestroyWarpOptions>;

/// Half the width of the bilinear kernel in cells of the raster. A whole number, because it reproduces a
/// sloping plane exactly.
double kernel_radius(double cell) {
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
    set("XSCALE", number_text(1 / kernel_radius(cell[0])));
    set("YSCALE", number_text(1 / kernel_radius(cell[1])));
    set("SOURCE_EXTRA", number_text(std::max(kernel_radius(cell[0]), kernel_radius(cell[1])) + 1));
    set("NUM_THREADS", "1");  // GdalMessages hears only its own thread
    return options;
}

/// Depends on the two grids alone, so that all windows use the same parts.
std::int32_t cols_for(const std::array<double, 2>& cell) {
    return static_cast<std::int32_t>(std::clamp(512 / std::max(1.0, cell[0]), 16.0, 512.0));
}

std::int32_t rows_for(const std::array<double, 2>& cell) {
    const double source_cells = cols_for(cell) * std::max(1.0, cell[0]) * std::max(1.0, cell[1]);
    return static_cast<std::int32_t>(std::clamp(max_source_cells / source_cells, 1.0, 1024.0));
}

}  // namespace

std::vector<Position> edge_of(const Window& part, int steps) {
    const double left = part.col;
    const double top = part.row;
    const double right = left + part.cols;
    const double bottom = top + part.rows;
    std::vector<Position> edge;
    for (int i = 0; i <= steps; ++i) {
        const double share = static_cast<double>(i) / steps;
        const double col = left + share * part.cols;
        const double row = top + share * part.rows;
        edge.insert(edge.end(), {{col, top}, {col, bottom}, {left, row}, {right, row}});
    }
    return edge;
}

std::optional<CellOffset> whole_cell_offset(const GridTransform& transform, const DemInfo& grid) {
    if (!transform.same_crs())
        return std::nullopt;
    const Window& w = grid.window;
    const double left = w.col;
    const double top = w.row;
    const double right = left + w.cols;
    const double bottom = top + w.rows;
    const std::array<Position, 4> corners{{{left, top}, {right, top}, {left, bottom}, {right, bottom}}};
    std::array<Position, 4> images = corners;
    transform.to_raster(images);
    const double cols = std::round(images[0].x - left);
    const double rows = std::round(images[0].y - top);
    constexpr double most = std::numeric_limits<std::int32_t>::max() / 2.0;
    if (!(std::abs(cols) < most && std::abs(rows) < most))
        return std::nullopt;
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (!(std::abs(images[i].x - corners[i].x - cols) < same_cell &&
              std::abs(images[i].y - corners[i].y - rows) < same_cell))
            return std::nullopt;
    return CellOffset{static_cast<std::int32_t>(rows), static_cast<std::int32_t>(cols)};
}

Coverage coverage(const GridTransform& transform, const DemInfo& raster, const DemInfo& grid) {
    const Window whole{0, 0, raster.rows, raster.cols};
    std::vector<Position> centres = cell_centres(grid.window);
    transform.to_raster(centres);
    const std::size_t covered = count_inside(centres, whole);
    if (covered > 0)
        return {static_cast<double>(covered) / static_cast<double>(centres.size()), true};
    std::vector<Position> others = cell_centres(whole);
    transform.to_grid(others);
    return {0, count_inside(others, grid.window) > 0};
}

std::array<double, 2> cell_size_in_raster(const GridTransform& transform, const DemInfo& grid) {
    const double col = grid.cols / 2.0;
    const double row = grid.rows / 2.0;
    std::array<Position, 3> p{{{col, row}, {col + 1, row}, {col, row + 1}}};
    transform.to_raster(p);
    const std::array<double, 2> size{std::hypot(p[1].x - p[0].x, p[2].x - p[0].x),
                                     std::hypot(p[1].y - p[0].y, p[2].y - p[0].y)};
    return std::isfinite(size[0] + size[1]) && size[0] > 0 && size[1] > 0 ? size : std::array{1.0, 1.0};
}

DatasetOwner value_dataset(ValueSource& source) {
    return DatasetOwner(GDALDataset::ToHandle(std::make_unique<ValueDataset>(source).release()));
}

ValueWarper::ValueWarper(BandReader& reader, const DemInfo& raster, const DemInfo& grid,
                         GridTransform transform, Resampling resampling, Warnings& warnings)
    : name_(raster.name),
      transform_(std::move(transform)),
      cell_(cell_size_in_raster(transform_, grid)),
      part_cols_(cols_for(cell_)),
      max_rows_(rows_for(cell_)),
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
    for (std::int32_t row = wanted.row; row < end_row; row += max_rows_)
        for (std::int32_t col = wanted.col - wanted.col % part_cols_; col < end_col; col += part_cols_) {
            const Window part{row, col, std::min(max_rows_, end_row - row), part_cols_};
            warp(part);
            const std::int32_t left = std::max(col, wanted.col);
            const std::int32_t right = std::min(col + part_cols_, end_col);
            for (std::int32_t i = 0; i < part.rows; ++i)
                std::copy_n(
                    part_.data() + std::ptrdiff_t{i} * part_cols_ + (left - col), right - left,
                    values.data() + std::ptrdiff_t{row - wanted.row + i} * wanted.cols + (left - wanted.col));
        }
}

bool ValueWarper::is_outside(const Window& part) const {
    constexpr int steps = 8;
    std::vector<Position> edge = edge_of(part, steps);
    transform_.to_raster(edge);
    return std::all_of(edge.begin(), edge.end(), [](const Position& p) { return std::isnan(p.x); });
}

void ValueWarper::warp(const Window& part) {
    part_.assign(static_cast<std::size_t>(part.rows) * static_cast<std::size_t>(part.cols),
                 std::numeric_limits<double>::quiet_NaN());
    if (is_outside(part))
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

}  // namespace d2b::reading
