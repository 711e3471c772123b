#include "write/existing_refusals.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "write/ogr_call.hpp"

namespace d2b {

namespace {

namespace fs = std::filesystem;

/// Returns the first file of the folder that is not part of our layers; "" if there is none.
std::string foreign_file(const fs::path& folder, GDALDatasetH dataset,
                         const std::vector<std::string>& names) {
    const CPLStringList listed(GDALGetFileList(dataset));
    for (const auto& entry : fs::directory_iterator(folder)) {
        std::string file = entry.path().filename().string();
        const bool part = CSLFindString(listed.List(), entry.path().c_str()) >= 0 ||
                          named(names, entry.path().stem().string()) ||
                          named(names, file.substr(0, file.find('.')));
        if (!part)
            return file;
    }
    return "";
}

/// Waits briefly for a lock, then throws. BEGIN IMMEDIATE is needed because other writers block it, but not
/// reading.
void refuse_locked(const Destination& destination, GDALDatasetH dataset) {
    using std::chrono::steady_clock;
    constexpr std::chrono::seconds longest(3);
    constexpr std::chrono::milliseconds between(50);
    for (const auto start = steady_clock::now();; std::this_thread::sleep_for(between)) {
        const GdalMessages messages;
        GDALDatasetExecuteSQL(dataset, "BEGIN IMMEDIATE", nullptr, nullptr);
        if (!messages.failed())
            break;
        if (steady_clock::now() - start > longest)
            throw OutputError("Cannot write \"" + destination.name + "\": locking it failed (" +
                              messages.reason_for(destination.path) + ")" + advice_for(messages.reason()) +
                              ".");
    }
    const GdalMessages quiet;
    GDALDatasetExecuteSQL(dataset, "ROLLBACK", nullptr, nullptr);
}

}  // namespace

bool named(const std::vector<std::string>& names, const std::string& name) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& other) { return EQUAL(other.c_str(), name.c_str()); });
}

void refuse_foreign(const Destination& destination, const ExistingDataset& existing, GDALDatasetH dataset,
                    const VectorFormat& format, const WriteOptions& options,
                    const std::vector<std::string>& names) {
    const std::string flag = options.overwrite ? "-overwrite" : "-append";
    if (options.overwrite || format.folder) {
        for (const std::string& layer : existing.layers)
            if (format.several_layers ? !named(names, layer) : existing.layers.size() > 1)
                throw OptionError(
                    "\"" + destination.name + "\" also holds layer \"" + layer + "\", which " + flag +
                    " would lose: " + format.name +
                    " datasets are replaced whole; write to another destination or remove it first.");
    }
    std::error_code error;
    if (!destination.local || !fs::is_directory(destination.path, error))
        return;
    const std::string file = foreign_file(destination.path, dataset, names);
    if (!file.empty())
        throw OptionError("The folder \"" + destination.name + "\" also holds \"" + file + "\", which " +
                          flag +
                          " would touch: folders are replaced whole; write to another folder or move it away "
                          "first.");
}

void require_writable(const Destination& destination, const VectorFormat& format, const WriteOptions& options,
                      const std::vector<std::string>& names) {
    const GdalMessages messages;
    if (destination.local && ::access(destination.path.c_str(), W_OK) != 0 && errno != ENOENT)
        throw OutputError("Cannot write \"" + destination.name + "\": it is read-only (" +
                          std::generic_category().message(errno) +
                          "); allow writing, or choose another destination.");
    const DatasetOwner dataset = open_dataset(format, destination.path, GDAL_OF_UPDATE);
    if (!dataset && format.transactions)
        throw OutputError("Cannot write \"" + destination.name + "\": opening it for writing failed (" +
                          messages.reason() + ")" + advice_for(messages.reason()) + ".");
    if (format.name == "GPKG" || format.name == "SQLite")
        refuse_locked(destination, dataset.get());
    if (!options.append)
        return;
    bool appendable = dataset != nullptr;
    for (int i = 0; appendable && i < GDALDatasetGetLayerCount(dataset.get()); ++i) {
        OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), i);
        if (!format.several_layers || named(names, OGR_L_GetName(layer)))
            appendable = OGR_L_TestCapability(layer, OLCSequentialWrite) != FALSE;
    }
    if (!appendable)
        throw OptionError("GDAL cannot append to \"" + destination.name + "\", a dataset of format " +
                          format.name + "; write to another destination, or to a GeoPackage.");
}

}  // namespace d2b
