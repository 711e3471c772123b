#include "read/cutline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <gdal_alg.h>
#include <ogr_api.h>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/grid.hpp"
#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/georeferencing.hpp"

namespace d2b::reading {

namespace {

bool meets(const ClipBox& box, const Window& w) {
    return box.right > w.col && box.left < static_cast<double>(w.col) + w.cols && box.top > w.row &&
           box.bottom < static_cast<double>(w.row) + w.rows;
}

/// Clips rings to a box and drops empty ones.
std::vector<WorldRing> clipped(const std::vector<WorldRing>& rings, const ClipBox& box) {
    std::vector<WorldRing> kept;
    for (const WorldRing& ring : rings)
        if (WorldRing part = clipped(ring, box); !part.empty())
            kept.push_back(std::move(part));
    return kept;
}

void add_polygon(const std::vector<WorldRing>& rings, RingProjector& projector, const SearchExtents& around,
                 std::vector<PixelPolygon>& polygons) {
    const bool on_earth =
        std::ranges::all_of(rings, [&](const WorldRing& ring) { return around.earth.holds(ring); });
    const std::vector<ClipBox> everywhere(1);
    for (const ClipBox& box : around.boxes.empty() || !on_earth ? everywhere : around.boxes) {
        PixelPolygon pixels;
        for (const WorldRing& ring : clipped(rings, box))
            pixels.push_back(projector.project(ring));
        if (!pixels.empty())
            polygons.push_back(std::move(pixels));
    }
}

/// Converts between pixel coordinates and a plane in metres, in which a buffer is as wide on all sides.
class PixelPlane {
  public:
    explicit PixelPlane(const DemInfo& info) {
        const AffineTransform& g = info.transform;
        const CellSize cell = cell_steps(info.window, Georeference(g, TraceMode::cells), Crs(info.crs_wkt));
        const double cosine = std::sqrt(std::max(0.0, 1 - cell.sine * cell.sine));
        across_ = cell.across;
        skew_ = std::copysign(cell.down * cosine, g[1] * g[2] + g[4] * g[5]);
        down_ = cell.down * cell.sine;
    }
    [[nodiscard]] Position metres(const Position& p) const {
        return {p.x * across_ + p.y * skew_, p.y * down_};
    }
    [[nodiscard]] Position pixels(const Position& p) const {
        const double row = p.y / down_;
        return {(p.x - row * skew_) / across_, row};
    }

  private:
    double across_ = 1;
    double skew_ = 0;
    double down_ = 1;
};

GeometryOwner in_metres(const PixelPolygon& polygon, const PixelPlane& plane) {
    GeometryOwner geometry(OGR_G_CreateGeometry(wkbPolygon));
    for (const WorldRing& ring : polygon) {
        GeometryOwner line(OGR_G_CreateGeometry(wkbLinearRing));
        for (const Position& pixel : ring) {
            const Position p = plane.metres(pixel);
            OGR_G_AddPoint_2D(line.get(), p.x, p.y);
        }
        OGR_G_CloseRings(line.get());
        OGR_G_AddGeometryDirectly(geometry.get(), line.release());
    }
    return geometry;
}

constexpr std::int64_t max_strip_cells = std::int64_t{1} << 24;

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

std::vector<PixelPolygon> read_cutline(const PolygonSource& source, const DemInfo& info, Warnings& warnings) {
    const std::string name = source.name();
    const NetworkGuard gate(source.path);
    const DatasetOwner dataset = open_source(source, warnings);
    const OGRLayerH layer = layer_of(dataset.get(), source, warnings);
    const TransformOwner transform = transform_to_dem(OGR_L_GetSpatialRef(layer), source, info, warnings);
    RingProjector projector(transform.get(), info.transform, name);
    SearchExtents around;
    if (transform)
        around = search_extents(OGR_L_GetSpatialRef(layer), horizontal_crs(info.crs_wkt).get(), info);
    std::vector<PixelPolygon> polygons;
    bool any = false;
    std::size_t invalid = 0;
    for_each_geometry(layer, "The " + name, warnings, [&](OGRFeatureH, OGRGeometryH geometry) {
        const GeometryOwner straight(OGR_G_GetLinearGeometry(geometry, 0, nullptr));  // arcs become lines
        if (!straight)
            return;
        for (OGRGeometryH const polygon : polygons_within(straight.get())) {
            const std::vector<WorldRing> rings = rings_of(polygon);
            any = any || !rings.empty();
            const std::size_t before = polygons.size();
            add_polygon(rings, projector, around, polygons);
            const bool is_used =
                std::any_of(polygons.begin() + static_cast<std::ptrdiff_t>(before), polygons.end(),
                            [&](const PixelPolygon& pixels) { return meets(box_of(pixels), info.window); });
            OGR_G_CloseRings(polygon);
            if (is_used && !is_valid(polygon))
                ++invalid;
        }
    });
    if (invalid == 1)
        warnings.add("A polygon of the " + name +
                     " is not valid, so the area that an odd number of its rings encloses is used; make it "
                     "valid, for example by ogr2ogr -makevalid.");
    else if (invalid > 1)
        warnings.add(std::to_string(invalid) + " polygons of the " + name +
                     " are not valid, so the area that an odd number of their rings encloses is used; make "
                     "them valid, for example by ogr2ogr -makevalid.");
    if (!any)
        throw InputError("The layer '" + std::string(OGR_L_GetName(layer)) + "' of the " + name +
                         " has no polygons; give one that has, for example with -" + source.layer_option +
                         ".");
    return polygons;
}

std::vector<PixelPolygon> buffered(const std::vector<PixelPolygon>& polygons, double metres,
                                   const DemInfo& info, const std::string& name) {
    constexpr int segments_per_quadrant = 8;
    const PixelPlane plane(info);
    const GdalMessages messages;
    std::vector<PixelPolygon> all;
    for (const PixelPolygon& polygon : polygons) {
        GeometryOwner area = in_metres(polygon, plane);
        if (!is_valid(area.get()))
            area.reset(OGR_G_MakeValid(area.get()));
        const GeometryOwner wide(area ? OGR_G_Buffer(area.get(), metres, segments_per_quadrant) : nullptr);
        if (!wide)
            throw InputError("The polygons of the " + name + " cannot be widened: " + messages.reason() +
                             "; make them valid, for example by ogr2ogr -makevalid.");
        for (OGRGeometryH const part : polygons_within(wide.get())) {
            PixelPolygon& pixels = all.emplace_back(rings_of(part));
            for (WorldRing& ring : pixels)
                for (Position& p : ring)
                    p = plane.pixels(p);
        }
    }
    return all;
}

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
        throw InputError("The polygons of the cutline, mask or -exclude cannot be rasterised: " +
                         messages.reason() + "; simplify them.");
}

void CutlineMask::apply(const Window& part, std::span<double> elevations) {
    if (part.cols == 0)
        return;
    const std::lock_guard lock(burning_);
    const auto cols = static_cast<std::size_t>(part.cols);
    const auto rows_per_strip =
        static_cast<std::int32_t>(std::max<std::int64_t>(1, max_strip_cells / part.cols));
    for (std::int32_t row = part.row; row < part.end_row(); ++row) {
        if (strip_.col != part.col || strip_.cols != part.cols || row < strip_.row || row >= strip_.end_row())
            burn({row, part.col, std::min(rows_per_strip, window_.end_row() - row), part.cols});
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
    const PolygonSource source{"cutline", "cutline_layer", options.cutline, options.cutline_layer};
    auto mask = std::make_unique<CutlineMask>(read_cutline(source, info, warnings), info.window);
    if (!mask->meets_window())
        warnings.add("The cutline '" + source.path + "' does not meet the part of '" + info.name +
                     "' that is used; no point of it is valid.");
    return mask;
}

}  // namespace d2b::reading
