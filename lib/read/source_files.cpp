#include "read/source_files.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include <cpl_string.h>
#include <cpl_vsi.h>

#include "core/warnings.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/open_raster.hpp"
#include "read/start_gdal.hpp"

namespace d2b {
namespace {

SourceFile stated(const std::string& name) {
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
    const FetchGate gate(dataset);
    const CPLStringList files(GDALGetFileList(dataset));
    for (int i = 0; i < files.size(); ++i)
        if (const std::string name = files[i]; names.insert(name).second && is_vrt(name))
            vrts.push_back(name);
    return vrts;
}

/// @param vrts those among the names, which have files of their own
std::vector<SourceFile> all_stated(std::set<std::string> names, std::vector<std::string> vrts) {
    // Descends into nested VRTs, because GDAL lists the files of a VRT but not those of VRTs among them.
    while (!vrts.empty()) {
        const DatasetOwner inner = open_gated(vrts.back(), GDAL_OF_RASTER);
        vrts.pop_back();
        if (inner)
            std::ranges::copy(add_files(inner.get(), names), std::back_inserter(vrts));
    }
    std::vector<SourceFile> files;
    files.reserve(names.size());
    for (const std::string& name : names)
        files.push_back(stated(name));
    return files;
}

}  // namespace

std::vector<SourceFile> source_files(const ReadOptions& options) {
    register_formats();
    Warnings unheard;
    const OpenRaster raster = open_raster(options, options.source, unheard);
    const GdalMessages messages(options.source, options.source);
    std::set<std::string> names;
    std::vector<std::string> vrts = add_files(raster.dataset.get(), names);
    return all_stated(std::move(names), std::move(vrts));
}

std::vector<SourceFile> side_files(const Options& options) {
    register_formats();
    std::vector<SourceFile> files;
    for (const std::string& path : {options.ground.terrain, options.detect.mask, options.detect.ndvi,
                                    options.detect.split_by, options.read.cutline}) {
        if (path.empty())
            continue;
        const GdalMessages messages;
        const DatasetOwner dataset = open_gated(path, GDAL_OF_RASTER | GDAL_OF_VECTOR);
        std::set<std::string> names{path};
        std::vector<std::string> vrts =
            dataset ? add_files(dataset.get(), names) : std::vector<std::string>();
        std::ranges::copy(all_stated(std::move(names), std::move(vrts)), std::back_inserter(files));
    }
    return files;
}

}  // namespace d2b
