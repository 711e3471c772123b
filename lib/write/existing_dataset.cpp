#include "write/existing_dataset.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <system_error>

#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "write/existing_refusals.hpp"
#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"
#include "write/postgresql_refusals.hpp"
#include "write/replacing_refusals.hpp"
#include "write/style_sidecar.hpp"

namespace d2b {

namespace {

namespace fs = std::filesystem;

/// Sidecar files of a .shp, replaced with it because an old index would not match the new file.
constexpr std::array shapefile_sidecars{".shx", ".dbf", ".prj", ".cpg", ".qix", ".sbn",
                                        ".sbx", ".qpj", ".idm", ".ind", ".cst"};

std::vector<std::string> files_of(GDALDatasetH dataset, const fs::path& path, const VectorFormat& format) {
    std::error_code error;
    if (fs::is_directory(path, error))
        return {path.string()};
    std::vector<std::string> files{path.string()};
    const auto add = [&](const fs::path& file) {
        if (file.parent_path() == path.parent_path() && fs::is_regular_file(file, error) &&
            std::find(files.begin(), files.end(), file.string()) == files.end())
            files.push_back(file.string());
    };
    const CPLStringList listed(GDALGetFileList(dataset));
    for (int i = 0; i < listed.Count(); ++i)
        add(listed[i]);
    if (format.name == "ESRI Shapefile" && format.suffixes.size() > 1)
        for (const char* suffix : shapefile_sidecars)
            add(fs::path(path).replace_extension(suffix));
    const fs::path style = fs::path(path).replace_extension(".qml");
    if (format.name == "ESRI Shapefile" && is_our_style(style))
        add(style);
    return files;
}

/// Advises to remove the file only if neither a disk error nor a lock is to blame.
[[noreturn]] void refuse_unopened(const Destination& destination, const VectorFormat& format,
                                  const GdalMessages& messages) {
    std::error_code error;
    std::ifstream file(destination.path, std::ios::binary);
    char first = 0;
    const bool unreadable = fs::is_regular_file(destination.path, error) &&
                            fs::file_size(destination.path, error) > 0 && !file.get(first);
    const std::array<const char*, 2> drivers{format.name.c_str(), nullptr};
    const bool ours = format.transactions && GDALIdentifyDriverEx(destination.path.c_str(), GDAL_OF_VECTOR,
                                                                  drivers.data(), nullptr) != nullptr;
    if (unreadable || ours)
        throw OutputError("Cannot write \"" + destination.name + "\": it exists and cannot be opened (" +
                          messages.reason_for(destination.path) + ")" + advice_for(messages.reason()) + ".");
    throw OptionError("\"" + destination.name + "\" exists and is not a dataset of format " + format.name +
                      "; remove it first.");
}

}  // namespace

ExistingDataset inspect_existing(const Destination& destination, const VectorFormat& format,
                                 const WriteOptions& options, const std::vector<std::string>& names) {
    const GdalMessages messages;
    const FetchGate gate(
        destination.path);  // because some drivers read on only when their layers are asked for
    ExistingDataset existing;
    // Opening for writing rolls back the transaction of a killed run; the file may be unreadable before.
    if (format.transactions)
        open_dataset(format, destination.path, GDAL_OF_UPDATE);
    DatasetOwner dataset = open_dataset(format, destination.path, GDAL_OF_READONLY);
    if (!dataset)  // datasets with rasters only must be opened as rasters
        dataset = open_dataset(format, destination.path, GDAL_OF_RASTER | GDAL_OF_READONLY);
    if (!dataset)
        refuse_unopened(destination, format, messages);
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset.get()); ++i)
        existing.layers.emplace_back(OGR_L_GetName(GDALDatasetGetLayer(dataset.get(), i)));
    if (destination.local)
        existing.files = files_of(dataset.get(), destination.path, format);
    existing.stamp = stamp_of(existing.files);
    if (!format.transactions)
        refuse_foreign(destination, existing, dataset.get(), format, options, names);
    if (options.overwrite)
        refuse_what_would_break(destination, dataset.get(), format, names);
    require_writable(destination, format, options, names);
    return existing;
}

std::optional<ExistingDataset> inspect_database(const Destination& destination, VectorFormat& format,
                                                const WriteOptions& options,
                                                const std::vector<std::string>& names) {
    const GdalMessages messages;
    const DatasetOwner dataset = open_dataset(format, destination.path, GDAL_OF_UPDATE);
    if (!dataset && format.name == "PostgreSQL")
        refuse_unreached_postgresql(destination, messages.reason());
    if (!dataset)
        return std::nullopt;
    format.transactions = GDALDatasetTestCapability(dataset.get(), ODsCTransactions) != FALSE &&
                          GDALDatasetTestCapability(dataset.get(), ODsCEmulatedTransactions) == FALSE;
    if (format.name == "PostgreSQL")
        refuse_unfit_postgresql(destination, dataset.get(), options, names);
    ExistingDataset existing;
    for (const std::string& name : names) {
        if (GDALDatasetGetLayerByName(dataset.get(), name.c_str()) == nullptr)
            continue;
        existing.layers.push_back(name);
        if (options.overwrite)
            refuse_what_would_break(destination, dataset.get(), format, {name});
        if (!options.overwrite && !options.append)
            throw OptionError(
                "\"" + destination.name + "\" has a layer \"" + name +
                "\"; give -overwrite to replace it, -append to add to it, or -nln for another name.");
    }
    return existing;
}

std::string stamp_of(const std::vector<std::string>& files) {
    std::string stamp;
    const auto add = [&stamp](const fs::path& path) {
        struct stat status {};
        if (::stat(path.c_str(), &status) == 0)
            stamp += path.string() + '|' + std::to_string(status.st_ino) + '|' +
                     std::to_string(status.st_size) + '|' + std::to_string(status.st_mtim.tv_sec) + '.' +
                     std::to_string(status.st_mtim.tv_nsec) + '\n';
    };
    std::error_code error;
    for (const std::string& file : files) {
        add(file);
        if (fs::is_directory(file, error))
            for (const auto& entry : fs::directory_iterator(file))
                add(entry.path());
    }
    return stamp;
}

}  // namespace d2b
