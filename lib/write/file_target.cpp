#include "write/file_target.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include <cpl_vsi.h>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/gdal_setup.hpp"
#include "write/destination.hpp"
#include "write/ogr_util.hpp"
#include "write/surface/surface_sink.hpp"

namespace d2b::writing {

namespace {

namespace fs = std::filesystem;

/// Sidecar files that GDAL would read as part of the new GeoTIFF.
constexpr std::array sidecars{".aux.xml", ".msk", ".ovr"};

std::string quoted(const std::string& text) {
    return "\"" + text + "\"";
}

/// Wording of messages about a format.
struct FormatWords {
    const char* is_written;
    const char* is_none;
};

FormatWords format_words(FileKind format) {
    switch (format) {
        case FileKind::picture:
            return {"a picture is written as", "not a PNG, SVG or PDF"};
        case FileKind::surface:
            return {"a surface is written as", "not a surface of this format"};
        case FileKind::materials:
            return {"the materials of an OBJ are written as", "not a material library (MTL)"};
        case FileKind::page:
            return {"a page is written as", "not a page of dem2buildings"};
        case FileKind::geotiff:
            break;
    }
    return {"GeoTIFF writes", "not a dataset of format GTiff"};
}

void require_name(const std::string& name, FileKind format) {
    if (format == FileKind::picture && !picture_format_of(name))
        throw OptionError("Pictures are written as PNG, SVG or PDF; give " + quoted(name) +
                          " a name that ends in .png, .svg or .pdf.");
    if (format == FileKind::surface && !surface_format_of(name))
        throw OptionError("Surfaces are written as " + surface_formats_advice(name) + ".");
    const std::string extension = to_lower(fs::path(name).extension().string());
    if (format == FileKind::page && extension != ".html")
        throw OptionError("Pages are written as HTML; give " + quoted(name) + " a name that ends in .html.");
    if (format == FileKind::geotiff && extension != ".tif" && extension != ".tiff")
        throw OptionError("Rasters are written as GeoTIFF; give " + quoted(name) +
                          " a name that ends in .tif.");
}

bool same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    return a == b || fs::equivalent(a, b, error) ||
           fs::weakly_canonical(fs::absolute(a, error), error) ==
               fs::weakly_canonical(fs::absolute(b, error), error);
}

/// True if a file belongs to a dataset, for example as a tile of a mosaic.
bool belongs_to_dataset(const std::string& path, const std::string& dataset_name) {
    std::error_code error;
    if (!fs::exists(dataset_name, error))  // pipes and connections are not opened
        return false;
    const reading::GdalMessages quiet;
    const reading::DatasetOwner dataset = reading::open_guarded(dataset_name, GDAL_OF_READONLY);
    const reading::NetworkGuard gate(dataset_name);
    const CPLStringList files(dataset ? GDALGetFileList(dataset.get()) : nullptr);
    for (int i = 0; i < files.Count(); ++i)
        if (same_file(path, files[i]))
            return true;
    return false;
}

void reject_in_use(const FileTarget& target, const std::string& path, bool exists) {
    for (const std::string& other : target.in_use)
        if (!other.empty() && (same_file(path, other) || (exists && belongs_to_dataset(path, other))))
            throw OptionError(quoted(target.destination) +
                              " is already read or written by this run; choose another name.");
}

std::string first_bytes_of(const std::string& path) {
    constexpr std::size_t most = 1024;
    std::string beginning(most, '\0');
    VSILFILE* file = VSIFOpenL(path.c_str(), "rb");
    beginning.resize(file == nullptr ? 0 : VSIFReadL(beginning.data(), 1, most, file));
    if (file != nullptr)
        VSIFCloseL(file);
    return beginning;
}

/// True if the existing file is of the format. @param place of an existing file
bool is_of(FileKind format, const FileDestination& place) {
    const reading::GdalMessages quiet;
    if (format == FileKind::picture)
        return begins_a_picture(first_bytes_of(place.path));
    if (format == FileKind::surface)
        return looks_like_surface(*surface_format_of(place.name), first_bytes_of(place.path));
    if (format == FileKind::materials)
        return looks_like_mtl(first_bytes_of(place.path));
    if (format == FileKind::page)
        return looks_like_page(first_bytes_of(place.path));
    const std::array<const char*, 2> drivers{"GTiff", nullptr};
    return reading::open_guarded(place.path, GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data()) != nullptr;
}

void check_local(const FileDestination& place, FileKind format) {
    std::error_code error;
    const fs::file_status status = fs::status(place.path, error);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw OptionError(quoted(place.name) + " is " +
                          (fs::is_directory(status) ? "a folder" : "not a regular file") + ", and " +
                          format_words(format).is_written + " a file; choose another name.");
    check_parent_folder(place.name, place.path);
    if (fs::exists(status))
        return;
    for (const char* suffix : sidecars)
        if (fs::exists(place.path + suffix, error))
            throw OptionError(quoted(place.path + suffix) + " would be read as a part of " +
                              quoted(place.name) + "; remove that file first or choose another name.");
}

bool exists(const FileDestination& place) {
    std::error_code error;
    VSIStatBufL status{};
    return place.local ? fs::exists(place.path, error)
                       : VSIStatExL(place.path.c_str(), &status, VSI_STAT_EXISTS_FLAG) == 0;
}

}  // namespace

std::optional<PictureFormat> picture_format_of(const std::string& name) {
    const std::string extension = to_lower(std::filesystem::path(name).extension().string());
    if (extension == ".png")
        return PictureFormat::png;
    if (extension == ".svg")
        return PictureFormat::svg;
    if (extension == ".pdf")
        return PictureFormat::pdf;
    return std::nullopt;
}

bool begins_a_picture(const std::string& beginning) {
    return beginning.starts_with("\x89PNG\r\n") || beginning.starts_with("%PDF-") ||
           beginning.find("<svg") != std::string::npos;
}

FileDestination resolve_file_target(const FileTarget& target) {
    reading::register_formats();
    const std::string& name = target.destination;
    require_name(name, target.format);
    reject_archive(name);
    FileDestination place;
    place.name = place.path = name;
    place.local = !name.starts_with("/vsi");
    if (place.local)
        place.path = resolved_path(name).string();
    const bool there = exists(place);
    reject_in_use(target, place.path, there);
    if (place.local)
        check_local(place, target.format);
    if (!there)
        return place;
    if (!target.overwrite)
        throw OptionError(quoted(name) + " exists; give another name, or -overwrite to replace it.");
    if (!is_of(target.format, place))
        throw OptionError(quoted(name) + " exists and is " + format_words(target.format).is_none +
                          "; remove it first.");
    place.old.files = {place.path};
    std::error_code error;
    for (const char* suffix : sidecars)
        if (place.local && fs::exists(place.path + suffix, error))
            place.old.files.push_back(place.path + suffix);
    place.old.stamp = stamp_of(place.old.files);
    return place;
}

}  // namespace d2b::writing
