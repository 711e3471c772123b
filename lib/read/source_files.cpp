#include "read/source_files.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>

#include "core/text.hpp"
#include "core/warnings.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/gdal_setup.hpp"
#include "read/open_raster.hpp"
#include "read/source_place.hpp"
#include "read/temporary_file.hpp"

namespace d2b::reading {

namespace {

/// Returns the first bytes of a file, or all if it is shorter.
std::string header_of(const std::string& path) {
    constexpr std::size_t most = 8;
    const GdalOwner<VSILFILE*, VSIFCloseL> file(VSIFOpenL(path.c_str(), "rb"));
    std::string head(most, '\0');
    head.resize(file ? VSIFReadL(head.data(), 1, most, file.get()) : 0);
    return head;
}

bool is_points(const std::string& path, const std::string& head) {
    const std::string name = to_lower(path);
    return head.starts_with("LASF") || name.ends_with(".las") || name.ends_with(".laz");
}

/// Returns GDAL's prefix for an archive, or "" if the file is not one.
std::string_view archive_prefix(const std::string& path, const std::string& head) {
    const std::string name = to_lower(path);
    if (head.starts_with("PK\x03\x04"))
        return "/vsizip/";
    if (name.ends_with(".tar") || name.ends_with(".tar.gz") || name.ends_with(".tgz"))
        return "/vsitar/";
    return head.starts_with("\x1f\x8b") ? "/vsigzip/" : "";
}

bool opens_as(unsigned kind, const std::string& path) {
    return open_guarded(path, kind | GDAL_OF_READONLY) != nullptr;
}

/// Returns the first raster in an archive, or "".
std::string raster_within(const std::string& archive) {
    constexpr int most = 1000;
    if (opens_as(GDAL_OF_RASTER, archive))
        return archive;
    const CPLStringList names(VSIReadDirRecursive(archive.c_str()));
    for (int i = 0; i < std::min(names.Count(), most); ++i) {
        std::string inside = archive + "/" + names[i];
        if (opens_as(GDAL_OF_RASTER, inside))
            return inside;
    }
    return "";
}

SourceFile stat_file(const std::string& name) {
    VSIStatBufL status;
    if (VSIStatL(name.c_str(), &status) != 0)
        return {name, -1, 0};
    return {name, static_cast<std::int64_t>(status.st_size), static_cast<std::int64_t>(status.st_mtime)};
}

bool is_vrt(const std::string& name) {
    return EQUAL(CPLGetExtension(name.c_str()), "vrt");
}

/// @return VRTs among the files of a dataset that were not known before
std::vector<std::string> add_files(GDALDatasetH dataset, std::set<std::string>& names) {
    std::vector<std::string> vrts;
    const NetworkGuard gate(dataset);
    const CPLStringList files(GDALGetFileList(dataset));
    for (int i = 0; i < files.size(); ++i)
        if (const std::string name = files[i]; names.insert(name).second && is_vrt(name))
            vrts.push_back(name);
    return vrts;
}

/// @param vrts those among the names, which have files of their own
std::vector<SourceFile> stat_files(std::set<std::string> names, std::vector<std::string> vrts) {
    // Descends into nested VRTs, because GDAL lists the files of a VRT but not those of VRTs among them.
    while (!vrts.empty()) {
        const DatasetOwner inner = open_guarded(vrts.back(), GDAL_OF_RASTER);
        vrts.pop_back();
        if (inner)
            std::ranges::copy(add_files(inner.get(), names), std::back_inserter(vrts));
    }
    std::vector<SourceFile> files;
    files.reserve(names.size());
    for (const std::string& name : names)
        files.push_back(stat_file(name));
    return files;
}

}  // namespace

std::string open_failure_advice(const std::string& path) {
    const GdalMessages quiet;
    const std::string head = header_of(path);
    if (is_points(path, head))
        return "; it is a point cloud, so make a raster of its highest points first, for example with "
               "tools/points/highest_points.js of dem2buildings or with PDAL (writers.gdal)";
    if (const std::string_view prefix = archive_prefix(path, head); !prefix.empty()) {
        const std::string raster = raster_within(std::string(prefix) + path);
        return raster.empty() ? "; it is an archive without a raster that GDAL reads"
                              : "; it is an archive, so give the raster in it: " + raster;
    }
    if (opens_as(GDAL_OF_VECTOR, path))
        return "; it holds vector layers, and the program needs a raster of elevations";
    return "";
}

std::string read_failure_advice(const std::string& path, const std::string& driver) {
    constexpr std::array servers{"WMS", "WCS", "WMTS", "OGCAPI", "EEDAI", "DAAS", "PLMOSAIC"};
    if (driver == "VRT")
        return "; check whether the files and functions that the VRT names are there";
    if (std::ranges::find(servers, driver) != servers.end() ||
        std::ranges::any_of(remote_prefixes, [&](const char* prefix) { return path.starts_with(prefix); }))
        return "; check whether the server answers, or copy the file here first";
    return "; the file may be truncated or damaged";
}

std::vector<SourceFile> source_files(const ReadOptions& options) {
    register_formats();
    Warnings ignored;
    const SourcePlace place(options);
    const OpenRaster raster = open_raster(options, place.path(), ignored);
    const GdalMessages messages(options.source, options.source);
    std::set<std::string> names;
    std::vector<std::string> vrts = add_files(raster.dataset.get(), names);
    if (!place.rasters().empty()) {  // the mosaic in memory is none of the user's files
        names.erase(place.path());
        std::erase(vrts, place.path());
    }
    return stat_files(std::move(names), std::move(vrts));
}

std::vector<SourceFile> list_auxiliary_files(const Options& options) {
    register_formats();
    std::vector<SourceFile> files;
    for (const std::string& path :
         {options.ground.terrain, options.detect.mask, options.detect.exclude, options.detect.corrections,
          options.detect.ndvi, options.detect.split_by, options.read.cutline, options.write.footprints}) {
        if (path.empty())
            continue;
        const GdalMessages messages;
        const DatasetOwner dataset = open_guarded(path, GDAL_OF_RASTER | GDAL_OF_VECTOR);
        std::set<std::string> names{path};
        std::vector<std::string> vrts =
            dataset ? add_files(dataset.get(), names) : std::vector<std::string>();
        std::ranges::copy(stat_files(std::move(names), std::move(vrts)), std::back_inserter(files));
    }
    return files;
}

}  // namespace d2b::reading
