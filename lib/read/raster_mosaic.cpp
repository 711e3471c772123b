#include "read/raster_mosaic.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include <cpl_string.h>
#include <gdal_utils.h>

#include "core/text.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "read/gdal_setup.hpp"
#include "read/georeferencing.hpp"
#include "read/open_raster.hpp"

namespace d2b::reading {

std::vector<std::string> read_raster_list(const std::string& list) {
    errno = 0;
    std::ifstream file(std::filesystem::path(list), std::ios::binary);
    std::vector<std::string> names;
    // errno is kept because a folder can be opened but not read.
    for (std::string line; std::getline(file, line);) {
        line.erase(line.find_last_not_of(" \t\r") + 1);
        if (!line.empty())
            names.push_back(line);
    }
    if (!file.is_open() || file.bad() || (names.empty() && errno != 0))
        throw InputError("'" + list + "' cannot be read: " + std::generic_category().message(errno) +
                         "; give a text file with one raster name per line.");
    if (names.empty())
        throw InputError("'" + list + "' names no raster; write one raster name per line.");
    return names;
}

bool are_disjoint(std::vector<RasterBox> boxes) {
    std::vector<RasterBox> ended = boxes;
    std::ranges::sort(boxes, {}, [](const RasterBox& box) { return box[1][0]; });
    std::ranges::sort(ended, {}, [](const RasterBox& box) { return box[1][1]; });
    auto next_end = ended.begin();
    // Sweep line: boxes that contain the row at which the next box begins, from left to right, [begin, end)
    // of columns.
    std::map<double, double> in_row;
    for (const auto& [cols, rows] : boxes) {
        for (; (*next_end)[1][1] <= rows[0]; ++next_end)
            in_row.erase((*next_end)[0][0]);
        const auto right = in_row.lower_bound(cols[0]);
        if (right != in_row.end() && right->first < cols[1])
            return false;
        if (right != in_row.begin() && std::prev(right)->second > cols[0])
            return false;
        in_row.emplace(cols[0], cols[1]);
    }
    return true;
}

namespace {

/// Tolerance in cells for cells of two rasters to coincide.
constexpr double grid_tolerance = 0.001;

/// Columns or rows of a raster.
struct RasterAxis {
    double first = 0;  ///< coordinate of its outer edge
    double step = 0;   ///< distance to the next cell
    double cells = 0;
};

/// Properties of a raster of the list, which is closed again.
struct MosaicRaster {
    std::string name;
    std::array<RasterAxis, 2> axes;
    GDALDataType type = GDT_Unknown;
    std::optional<double> nodata;
    std::string unit;
    CrsOwner crs;
};

[[noreturn]] void refuse(const std::string& name, const std::string& why, const std::string& advice) {
    throw InputError("'" + name + "' cannot be a part of a mosaic: " + why + "; " + advice +
                     ", leave it out, or join the rasters with gdalbuildvrt and give its mosaic.");
}

MosaicRaster read_mosaic_raster(const std::string& name, int band) {
    ReadOptions options;
    options.source = name;
    options.band = band;
    Warnings ignored;
    const OpenRaster raster = open_raster(options, name, ignored);
    const GdalMessages quiet;
    GDALDatasetH dataset = raster.dataset.get();
    std::array<double, 6> to{};
    if (GDALGetGeoTransform(dataset, to.data()) != CE_None)
        refuse(name, "it has no georeferencing", "give it corners with gdal_translate -a_ullr");
    if (to[2] != 0 || to[4] != 0 || !(to[1] > 0) || !(to[5] < 0))
        refuse(name, "it is rotated or upside down", "bring it onto the grid of the others with gdalwarp");
    MosaicRaster here;
    here.name = name;
    here.axes = {{{to[0], to[1], static_cast<double>(GDALGetRasterXSize(dataset))},
                  {to[3], to[5], static_cast<double>(GDALGetRasterYSize(dataset))}}};
    here.type = GDALGetRasterDataType(raster.band);
    int known = FALSE;
    if (const double nodata = GDALGetRasterNoDataValue(raster.band, &known); known != FALSE)
        here.nodata = nodata;
    here.unit = GDALGetRasterUnitType(raster.band);
    if (OGRSpatialReferenceH crs = GDALGetSpatialRef(dataset); !wkt_of(crs).empty())
        here.crs.reset(OSRClone(crs));
    return here;
}

bool same_crs(const MosaicRaster& a, const MosaicRaster& b) {
    if (a.crs == nullptr || b.crs == nullptr)
        return a.crs == b.crs;
    const std::array<const char*, 2> criteria{"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", nullptr};
    return OSRIsSameEx(a.crs.get(), b.crs.get(), criteria.data()) != FALSE;
}

void require_same_grid(const MosaicRaster& first, const MosaicRaster& other) {
    const std::string where = " than '" + first.name + "'";
    const std::string warp = "bring it onto that grid with gdalwarp";
    if (!same_crs(first, other))
        refuse(other.name, "it has another coordinate reference system" + where, warp);
    for (std::size_t i = 0; i < first.axes.size(); ++i) {
        const RasterAxis& a = first.axes[i];
        const RasterAxis& b = other.axes[i];
        if (std::abs(b.step / a.step - 1) * b.cells > grid_tolerance)
            refuse(other.name, "it has cells of another size" + where, warp);
        const double offset = (b.first - a.first) / a.step;
        if (std::abs(offset - std::round(offset)) > grid_tolerance)
            refuse(other.name, "its cells lie between those of '" + first.name + "'", warp);
    }
    if (other.type != first.type)
        refuse(other.name,
               std::string("it holds ") + GDALGetDataTypeName(other.type) + ", not " +
                   GDALGetDataTypeName(first.type) + " as '" + first.name + "'",
               "give it that type with gdal_translate -ot");
    if (other.unit != first.unit)
        refuse(
            other.name,
            "it says that its unit is '" + other.unit + "', not '" + first.unit + "' as '" + first.name + "'",
            "set the right one with gdal_edit.py -units");
}

/// Value that stands for NoData if no raster declares one.
double fallback_nodata(GDALDataType type) {
    switch (type) {
        case GDT_Byte:
            return std::numeric_limits<std::uint8_t>::max();
        case GDT_UInt16:
            return std::numeric_limits<std::uint16_t>::max();
        case GDT_UInt32:
            return std::numeric_limits<std::uint32_t>::max();
        case GDT_Int16:
            return std::numeric_limits<std::int16_t>::min();
        case GDT_Int32:
            return std::numeric_limits<std::int32_t>::min();
        default:
            return std::numeric_limits<double>::quiet_NaN();
    }
}

/// Returns the cells of the rasters on the grid of the first one.
std::vector<RasterBox> boxes_of(const std::vector<MosaicRaster>& rasters) {
    std::vector<RasterBox> boxes(rasters.size());
    for (std::size_t k = 0; k < rasters.size(); ++k)
        for (std::size_t i = 0; i < boxes[k].size(); ++i) {
            const RasterAxis& axis = rasters[k].axes[i];
            const RasterAxis& origin = rasters.front().axes[i];
            const double first = std::round((axis.first - origin.first) / origin.step);
            boxes[k][i] = {first, first + axis.cells};
        }
    return boxes;
}

/// Returns true if the rasters have at least as many cells as the mosaic.
bool may_cover_extent(const std::vector<RasterBox>& boxes) {
    std::array<double, 2> least{};
    std::array<double, 2> most{};
    double cells = 0;
    for (const RasterBox& box : boxes) {
        cells += (box[0][1] - box[0][0]) * (box[1][1] - box[1][0]);
        for (std::size_t i = 0; i < box.size(); ++i) {
            least[i] = std::min(least[i], box[i][0]);
            most[i] = std::max(most[i], box[i][1]);
        }
    }
    return cells >= (most[0] - least[0]) * (most[1] - least[1]);
}

/// Returns the NoData value of the mosaic, because GDAL would otherwise fill gaps between rasters with 0.
std::optional<double> nodata_of(const std::vector<MosaicRaster>& rasters) {
    for (const MosaicRaster& raster : rasters)
        if (raster.nodata)
            return raster.nodata;
    if (may_cover_extent(boxes_of(rasters)))
        return {};
    return fallback_nodata(rasters.front().type);
}

/// Returns true if every cell takes the value of at most one raster, whatever that value is, so that GDAL can
/// copy rows instead of testing each cell.
bool can_copy_rows(const std::vector<MosaicRaster>& rasters, double nodata) {
    const auto fits = [&](const MosaicRaster& raster) {
        return !raster.nodata || *raster.nodata == nodata ||
               (std::isnan(*raster.nodata) && std::isnan(nodata));
    };
    return std::ranges::all_of(rasters, fits) && are_disjoint(boxes_of(rasters));
}

}  // namespace

void build_mosaic(const std::string& path, const std::vector<std::string>& rasters, int band) {
    register_formats();
    std::vector<MosaicRaster> all;
    for (const std::string& name : rasters) {
        all.push_back(read_mosaic_raster(name, band));
        require_same_grid(all.front(), all.back());
    }
    CPLStringList words;
    words.AddString("-strict");  // reports rasters that do not fit instead of leaving them out
    if (const std::optional<double> nodata = nodata_of(all)) {
        words.AddString("-vrtnodata");
        words.AddString(number_text(*nodata).c_str());
        if (can_copy_rows(all, *nodata)) {
            words.AddString("-srcnodata");
            words.AddString("None");
        }
    }
    const GdalMessages messages;
    const GdalOwner<GDALBuildVRTOptions*, GDALBuildVRTOptionsFree> options(
        GDALBuildVRTOptionsNew(words.List(), nullptr));
    const StringList names(rasters);
    int wrong = FALSE;
    DatasetOwner mosaic(GDALBuildVRT(path.c_str(), static_cast<int>(rasters.size()), nullptr, names.get(),
                                     options.get(), &wrong));
    if (!mosaic)
        throw InputError("The rasters cannot be made into a mosaic: " + messages.reason() +
                         "; join them with gdalbuildvrt and give its mosaic.");
    mosaic.reset();  // writes the file
    if (messages.failed())
        throw OutputError("'" + path + "' cannot be written: " + messages.reason() +
                          "; free some space in the work folder, or give another one.");
}

}  // namespace d2b::reading
