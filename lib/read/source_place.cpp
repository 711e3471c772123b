#include "read/source_place.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <cpl_vsi.h>
#include <gdal.h>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/raster_mosaic.hpp"

namespace d2b::reading {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mosaic_ending = ".vrt";

std::string ending_of(const std::string& path) {
    return to_lower(fs::path(path).extension().string());
}

/// Returns true for files that GDAL opens as rasters but that belong to others.
bool is_companion(const std::string& path) {
    constexpr std::array endings{".ovr", ".msk", ".xml", ".aux"};
    return std::ranges::find(endings, ending_of(path)) != endings.end();
}

bool is_raster(const std::string& path) {
    const GdalMessages quiet;
    return GDALIdentifyDriverEx(path.c_str(), GDAL_OF_RASTER, nullptr, nullptr) != nullptr;
}

/// Returns true for a database such as a GeoPackage that holds no raster.
bool is_only_vector(const std::string& path) {
    const GdalMessages quiet;
    return open_guarded(path, GDAL_OF_RASTER | GDAL_OF_READONLY) == nullptr &&
           open_guarded(path, GDAL_OF_VECTOR | GDAL_OF_READONLY) != nullptr;
}

/// Returns true for a raster that a run has written, as -write_ground does.
bool is_result(const std::string& path) {
    const GdalMessages quiet;
    const auto raster = open_guarded(path, GDAL_OF_RASTER | GDAL_OF_READONLY);
    return raster != nullptr && GDALGetMetadataItem(raster.get(), "D2B_VERSION", nullptr) != nullptr;
}

std::vector<std::string> files_in(const std::string& folder) {
    std::error_code error;
    std::vector<std::string> files;
    for (fs::directory_iterator file(folder, error); !error && file != fs::directory_iterator();
         file.increment(error))
        if (const fs::path& path = file->path();
            !path.filename().string().starts_with('.') && file->is_regular_file(error))
            files.push_back(path.string());
    if (error)
        throw InputError("The folder '" + folder + "' cannot be read: " + error.message() + ".");
    std::ranges::sort(files);
    return files;
}

std::vector<std::string> rasters_in_folder(const std::string& folder) {
    std::vector<std::string> files = files_in(folder);
    std::erase_if(files, is_companion);
    std::set<std::string> endings;
    for (const std::string& file : files)
        if (is_raster(file))
            endings.insert(ending_of(file));
    // A mosaic usually joins the rasters beside it, and pictures show them.
    for (const std::string_view ending : {mosaic_ending, std::string_view(".pdf"), std::string_view(".png"),
                                          std::string_view(".jpg"), std::string_view(".gif")})
        if (endings.size() > 1)
            endings.erase(std::string(ending));
    // Takes files by their ending, so that a truncated raster is refused instead of missed.
    std::erase_if(files, [&](const std::string& file) {
        return !endings.contains(ending_of(file)) || is_only_vector(file) || is_result(file);
    });
    if (files.empty())
        throw InputError("The folder '" + folder +
                         "' holds no raster that GDAL reads; give a raster, several, or another folder.");
    return files;
}

/// Returns true for a folder that GDAL does not open as a raster itself, as it does with ESRI grids.
bool is_folder_of_files(const std::string& source) {
    std::error_code error;
    return fs::is_directory(source, error) && !is_raster(source);
}

void require_mosaic_options(const ReadOptions& options) {
    for (const auto& [name, given] :
         {std::pair{"-if", !options.drivers.empty()}, std::pair{"-oo", !options.open_options.empty()}})
        if (given)
            throw OptionError(
                std::string(name) +
                " applies to one raster, and the source is several; join them with gdalbuildvrt "
                "and give its mosaic.");
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

std::string first_and_others(const std::vector<std::string>& names) {
    return names.front() + " and " + std::to_string(names.size() - 1) +
           (names.size() == 2 ? " other" : " others");
}

}  // namespace

std::vector<std::string> rasters_of(const std::string& source) {
    std::error_code error;
    // The XML of a VRT, which GDAL takes as a name, has lines as well.
    const std::size_t first = source.find_first_not_of(" \t\n");
    if (source.find('\n') != std::string::npos && first != std::string::npos && source[first] != '<' &&
        source[first] != '{' && !fs::exists(source, error))
        return lines_of(source);
    return is_folder_of_files(source) ? rasters_in_folder(source) : std::vector<std::string>();
}

SourcePlace::SourcePlace(const ReadOptions& options)
    : rasters_(rasters_of(options.source)), path_(options.source), name_(options.source) {
    if (rasters_.empty()) {
        standard_input_ = copy_standard_input(options.source);
        if (standard_input_)
            path_ = standard_input_->path();
        return;
    }
    for (const std::string& raster : rasters_)
        if (is_standard_input(raster))
            throw OptionError("'" + raster +
                              "' cannot be one of several sources, because it can be read only once; give "
                              "files.");
    require_mosaic_options(options);
    if (options.source.starts_with(rasters_.front() + '\n'))
        name_ = first_and_others(rasters_);
    static std::atomic<int> number = 0;
    path_ = "/vsimem/dem2buildings_source_" + std::to_string(++number) + std::string(mosaic_ending);
    try {
        build_mosaic(path_, rasters_, options.band);
    } catch (...) {
        VSIUnlink(path_.c_str());
        throw;
    }
}

SourcePlace::~SourcePlace() {
    if (!rasters_.empty())
        VSIUnlink(path_.c_str());
}

}  // namespace d2b::reading
