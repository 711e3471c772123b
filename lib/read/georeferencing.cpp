#include "read/georeferencing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <ogr_spatialref.h>

#include "core/crs.hpp"
#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"

namespace d2b::reading {

namespace {

/// Returns true if cells have an area: a determinant within the rounding error of its terms counts as zero.
bool invertible(const AffineTransform& g) {
    if (!std::all_of(g.begin(), g.end(), [](double term) { return std::isfinite(term); }))
        return false;
    const double determinant = g[1] * g[5] - g[2] * g[4];
    return std::abs(determinant) > 1e-12 * std::hypot(g[1], g[4]) * std::hypot(g[2], g[5]);
}

std::string wkt_from_user(const std::string& text) {
    if (const std::string code = guess_epsg_code(text); !code.empty())
        throw OptionError("-a_srs " + text + " is not a coordinate reference system; write -a_srs " + code +
                          " if that is meant.");
    const GdalMessages messages;
    OGRSpatialReference crs;
    // Limits GDAL because the text may come from an untrusted caller of the library and must not make it open
    // files or connections.
    const OGRErr status =
        crs.SetFromUserInput(text.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
    std::string wkt = status == OGRERR_NONE ? wkt_of(OGRSpatialReference::ToHandle(&crs)) : "";
    if (wkt.empty())
        throw OptionError("-a_srs " + one_line(text) + " is not a coordinate reference system (" +
                          messages.reason() +
                          "); give a code such as EPSG:25832, WKT, PROJJSON or a PROJ string.");
    return wkt;
}

/// Returns true for the placeholders that GDAL derives from codes 0 and -1 (unknown CRS) of a GeoPackage and
/// writes on into other files. The degrees of the first are not real.
bool is_placeholder(OGRSpatialReferenceH crs) {
    const char* name = OSRGetName(crs);
    return name != nullptr && OSRGetAuthorityCode(crs, nullptr) == nullptr &&
           (EQUAL(name, "Undefined geographic SRS") || EQUAL(name, "Undefined Cartesian SRS") ||
            EQUAL(name, "Undefined SRS"));
}

/// Axis of a grid: the centre of cell i is at origin + (i + 0.5) * step.
struct Axis {
    double origin = 0;
    double step = 1;
    std::int32_t cells = 0;

    [[nodiscard]] double low() const { return std::min(origin, origin + step * cells); }
    [[nodiscard]] double high() const { return std::max(origin, origin + step * cells); }
};

struct CellRange {
    std::int32_t first = 0;
    std::int32_t count = 0;
};

/// Returns the fractional index of the cell whose centre is at a coordinate. Rounds within a millionth of a
/// cell, because decimal coordinates are seldom exact in binary.
double cell_at(const Axis& axis, double coordinate) {
    const double cell = (coordinate - axis.origin) / axis.step - 0.5;
    const double nearest = std::round(cell);
    return std::abs(cell - nearest) < 1e-6 ? nearest : cell;
}

/// Returns the cells with low <= centre < high, clipped to the grid.
CellRange cells_between(const Axis& axis, double low, double high) {
    double first = std::ceil(cell_at(axis, low));
    double end = std::ceil(cell_at(axis, high));
    if (axis.step < 0) {  // index decreases with the coordinate
        first = std::floor(cell_at(axis, high)) + 1;
        end = std::floor(cell_at(axis, low)) + 1;
    }
    const auto cells = static_cast<double>(axis.cells);
    first = std::clamp(first, 0.0, cells);
    end = std::clamp(end, 0.0, cells);
    return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(std::max(0.0, end - first))};
}

std::string size_text(const DemInfo& info) {
    return "the raster has " + std::to_string(info.cols) + " columns and " + std::to_string(info.rows) +
           " rows";
}

Window from_cells(const std::array<double, 4>& cells, const DemInfo& info) {
    const auto& [col, row, cols, rows] = cells;
    const std::string option = "-srcwin " + numbers_text(cells, " ");
    for (const double value : cells)
        if (!std::isfinite(value) || value != std::floor(value))
            throw OptionError(option + " must be whole numbers of cells (column row columns rows); " +
                              size_text(info) + ".");
    if (col < 0 || row < 0 || cols < 1 || rows < 1 || col + cols > info.cols || row + rows > info.rows)
        throw OptionError(option + " (column row columns rows) does not lie inside the raster; " +
                          size_text(info) + ".");
    return {static_cast<std::int32_t>(row), static_cast<std::int32_t>(col), static_cast<std::int32_t>(rows),
            static_cast<std::int32_t>(cols)};
}

bool within(const Axis& axis, double low, double high) {
    return axis.low() <= low && low < high && high <= axis.high();
}

/// Returns the right order if x and y were exchanged. @param box xmin, ymin, xmax, ymax
std::string order_hint(const std::array<double, 4>& box, const Axis& x, const Axis& y) {
    const auto& [a, b, c, d] = box;
    if (!within(x, b, d) || !within(y, a, c))
        return "";
    return "; x comes before y, so write -te " + numbers_text(std::array{b, a, d, c}, " ");
}

/// @param extent xmin, ymin, xmax, ymax
Window from_extent(const std::array<double, 4>& extent, const std::string& option, const DemInfo& info) {
    const AffineTransform& g = info.transform;
    if (g[2] != 0 || g[4] != 0)
        throw OptionError(option +
                          " cannot be used, since the rows of the raster do not run along the x axis; " +
                          "give the window in cells with -srcwin.");
    const Axis x{g[0], g[1], info.cols};
    const Axis y{g[3], g[5], info.rows};
    const CellRange cols = cells_between(x, extent[0], extent[2]);
    const CellRange rows = cells_between(y, extent[1], extent[3]);
    if (cols.count == 0 || rows.count == 0)
        throw OptionError(option + " holds no cell centre of the raster, which extends from " +
                          number_text(x.low()) + " to " + number_text(x.high()) + " in x and from " +
                          number_text(y.low()) + " to " + number_text(y.high()) + " in y" +
                          (option.starts_with("-te") ? order_hint(extent, x, y) : "") + ".");
    return {rows.first, cols.first, rows.count, cols.count};
}

Window from_corners(const std::array<double, 4>& corners, const DemInfo& info) {
    const auto& [ulx, uly, lrx, lry] = corners;
    const std::string option = "-projwin " + numbers_text(corners, " ");
    if (!(ulx < lrx && lry < uly))
        throw OptionError(option + " must be the upper left and the lower right corner (ulx uly lrx lry, " +
                          "ulx < lrx and lry < uly).");
    return from_extent({ulx, lry, lrx, uly}, option, info);
}

Window from_box(const std::array<double, 4>& box, const DemInfo& info) {
    const auto& [xmin, ymin, xmax, ymax] = box;
    const std::string option = "-te " + numbers_text(box, " ");
    if (!(xmin < xmax && ymin < ymax))
        throw OptionError(option + " must be xmin ymin xmax ymax with xmin < xmax and ymin < ymax.");
    return from_extent(box, option, info);
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

std::string wkt_of(OGRSpatialReferenceH crs) {
    if (crs == nullptr || OGRSpatialReference::FromHandle(crs)->IsEmpty() != FALSE || is_placeholder(crs))
        return {};
    constexpr std::array<const char*, 3> options{"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
    char* text = nullptr;
    const OGRErr status = OSRExportToWktEx(crs, &text, options.data());
    const std::unique_ptr<char, GdalRelease<void*, VSIFree>> owner(text);
    // Repairs names, because those in GeoTIFF keys or a .prj may be in any encoding.
    return status == OGRERR_NONE && text != nullptr ? utf8_text(text) : "";
}

void set_crs(const std::string& own_wkt, const std::string& user_crs, DemInfo& info, Warnings& warnings) {
    info.crs_wkt = user_crs.empty() ? own_wkt : wkt_from_user(user_crs);
    const Crs crs(info.crs_wkt);
    require_plane(crs, user_crs.empty() ? "" : "-a_srs " + one_line(user_crs), info.name);
    if (!info.georeferenced && user_crs.empty() && crs.kind() == Crs::Kind::geographic) {
        info.crs_wkt.clear();
        warnings.add("'" + info.name +
                     "' has a coordinate reference system in degrees, but its coordinates are columns and " +
                     "rows; it is ignored.");
        return;
    }
    if (info.crs_wkt.empty())
        warnings.add("'" + info.name +
                     "' has no coordinate reference system; lengths are taken as plain units; " +
                     "give it with -a_srs.");
}

void read_crs(GDALDatasetH dataset, const std::string& user_crs, DemInfo& info, Warnings& warnings) {
    set_crs(user_crs.empty() ? wkt_of(GDALGetSpatialRef(dataset)) : "", user_crs, info, warnings);
}

CrsOwner horizontal_crs(const std::string& wkt) {
    if (wkt.empty())
        return nullptr;
    CrsOwner crs(OSRNewSpatialReference(wkt.c_str()));
    if (!crs)
        return crs;
    OSRSetAxisMappingStrategy(crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    if (OSRIsCompound(crs.get()) != FALSE)
        OSRStripVertical(crs.get());
    OSRDemoteTo2D(crs.get(), nullptr);
    return crs;
}

Window choose_window(const ReadOptions& options, const DemInfo& info) {
    const int given = static_cast<int>(options.source_window.has_value()) +
                      static_cast<int>(options.projected_window.has_value()) +
                      static_cast<int>(options.extent.has_value());
    if (given > 1)
        throw OptionError("-srcwin, -projwin and -te exclude each other; give only one of them.");
    if (options.source_window)
        return from_cells(*options.source_window, info);
    if (options.projected_window)
        return from_corners(*options.projected_window, info);
    if (options.extent)
        return from_box(*options.extent, info);
    return {0, 0, info.rows, info.cols};
}

std::string extent_order_warning(const ReadOptions& options, const DemInfo& info) {
    const AffineTransform& g = info.transform;
    if (!options.extent || g[2] != 0 || g[4] != 0)
        return "";
    const Axis x{g[0], g[1], info.cols};
    const Axis y{g[3], g[5], info.rows};
    const auto& [a, b, c, d] = *options.extent;
    if ((within(x, a, c) && within(y, b, d)) || !within(x, a, b) || !within(y, c, d))
        return "";
    return "-te " + numbers_text(*options.extent, " ") +
           " (xmin ymin xmax ymax) reaches beyond the raster; if it is xmin xmax ymin ymax, as QGIS has it, "
           "write -te " +
           numbers_text(std::array{a, c, b, d}, " ") + ".";
}

void require_part(const DemInfo& info, const Window& part, std::size_t size) {
    const Window& w = info.window;
    const bool inside = part.rows >= 0 && part.cols >= 0 && part.row >= w.row && part.col >= w.col &&
                        part.rows <= w.rows - (part.row - w.row) && part.cols <= w.cols - (part.col - w.col);
    if (!inside || size != static_cast<std::size_t>(part.points()))
        throw InputError(std::to_string(part.rows) + " rows from " + std::to_string(part.row) + " on and " +
                         std::to_string(part.cols) + " columns from " + std::to_string(part.col) +
                         " on were asked for outside the window of '" + info.name +
                         "' or for a buffer of another size; ask for a part of the window.");
}

}  // namespace d2b::reading
