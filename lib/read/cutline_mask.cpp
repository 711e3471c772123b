#include "read/cutline_mask.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include <gdal_alg.h>
#include <ogr_api.h>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"

namespace d2b {

namespace {

constexpr std::int64_t most_strip_cells = std::int64_t{1} << 24;

/// Pixel coordinates of the first cell of a strip.
struct Corner {
    double col = 0;
    double row = 0;
};

/// GDALTransformerFunc from pixel coordinates of the DEM to those of a strip. Needed because GDAL's own
/// transformers treat an identity as a missing georeference.
int shift(void* argument, int to_source, int count, double* x, double* y, double*, int* success) {
    const auto* corner = static_cast<const Corner*>(argument);
    const double sign = to_source != 0 ? 1.0 : -1.0;
    for (int i = 0; i < count; ++i) {
        x[i] += sign * corner->col;
        y[i] += sign * corner->row;
        success[i] = TRUE;
    }
    return TRUE;
}

/// Limits of clipping, because GDAL counts cells in 32 bits. Geometry farther away than any side is long
/// makes no difference.
ClipBox countable(const Window& w) {
    constexpr double room = 1e8;
    return {w.col - room, w.row - room, w.col + w.cols + room, w.row + w.rows + room};
}

GeometryOwner to_geometry(const PixelPolygon& polygon, const Window& window) {
    GeometryOwner geometry(OGR_G_CreateGeometry(wkbPolygon));
    for (const WorldRing& whole : polygon) {
        const WorldRing ring = clipped(whole, countable(window));
        GeometryOwner line(OGR_G_CreateGeometry(wkbLinearRing));
        OGR_G_SetPointCount(line.get(), static_cast<int>(ring.size()));
        for (std::size_t i = 0; i < ring.size(); ++i)
            OGR_G_SetPoint_2D(line.get(), static_cast<int>(i), ring[i].x, ring[i].y);
        OGR_G_CloseRings(line.get());
        OGR_G_AddGeometryDirectly(geometry.get(), line.release());
    }
    return geometry;
}

}  // namespace

CutlineMask::CutlineMask(const std::vector<PixelPolygon>& polygons, const Window& window) : window_(window) {
    for (const PixelPolygon& polygon : polygons)
        if (const ClipBox box = box_of(polygon); meets(box, window))
            shapes_.push_back({box, to_geometry(polygon, window)});
}

void CutlineMask::burn(const Window& strip) {
    strip_ = strip;
    inside_.assign(static_cast<std::size_t>(strip.points()), 0);
    // Burns polygons separately, not as one geometry, because points in an overlap of two polygons are
    // inside.
    std::vector<OGRGeometryH> handles;
    for (const Shape& shape : shapes_)
        if (meets(shape.box, strip))
            handles.push_back(shape.geometry.get());
    if (handles.empty())
        return;
    const GdalMessages messages;
    const DatasetOwner cells(
        GDALCreate(GDALGetDriverByName("MEM"), "", strip.cols, strip.rows, 1, GDT_Byte, nullptr));
    const std::vector<double> ones(handles.size(), 1.0);
    Corner corner{static_cast<double>(strip.col), static_cast<double>(strip.row)};
    constexpr std::array<int, 1> bands{1};
    if (!cells ||
        GDALRasterizeGeometries(cells.get(), 1, bands.data(), static_cast<int>(handles.size()),
                                handles.data(), shift, &corner, ones.data(), nullptr, nullptr,
                                nullptr) != CE_None ||
        GDALRasterIO(GDALGetRasterBand(cells.get(), 1), GF_Read, 0, 0, strip.cols, strip.rows, inside_.data(),
                     strip.cols, strip.rows, GDT_Byte, 0, 0) != CE_None)
        throw InputError("The polygons of the cutline or mask cannot be rasterised: " + messages.reason() +
                         "; simplify them.");
}

void CutlineMask::apply(const Window& part, std::span<double> elevations) {
    if (part.cols == 0)
        return;
    const std::lock_guard lock(burning_);
    const auto cols = static_cast<std::size_t>(part.cols);
    const auto rows_a_strip =
        static_cast<std::int32_t>(std::max<std::int64_t>(1, most_strip_cells / part.cols));
    for (std::int32_t row = part.row; row < part.end_row(); ++row) {
        if (strip_.col != part.col || strip_.cols != part.cols || row < strip_.row || row >= strip_.end_row())
            burn({row, part.col, std::min(rows_a_strip, window_.end_row() - row), part.cols});
        const std::uint8_t* inside = inside_.data() + static_cast<std::size_t>(row - strip_.row) * cols;
        const std::span<double> line =
            elevations.subspan(static_cast<std::size_t>(row - part.row) * cols, cols);
        for (std::size_t col = 0; col < cols; ++col)
            if (inside[col] == 0)
                line[col] = std::numeric_limits<double>::quiet_NaN();
    }
}

std::unique_ptr<CutlineMask> open_cutline(const ReadOptions& options, const DemInfo& info,
                                          Warnings& warnings) {
    if (options.cutline.empty())
        return nullptr;
    const PolygonPlace place{"cutline", "cutline_layer", options.cutline, options.cutline_layer};
    auto mask = std::make_unique<CutlineMask>(read_cutline(place, info, warnings), info.window);
    if (!mask->meets_window())
        warnings.add("The cutline '" + place.path + "' does not meet the part of '" + info.name +
                     "' that is used; no point of it is valid.");
    return mask;
}

}  // namespace d2b
