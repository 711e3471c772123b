#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <cpl_string.h>
#include <cpl_vsi.h>

#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "write/ogr_util.hpp"

namespace d2b::writing {

/// Returns the names of the files and folders in a folder, local or virtual.
[[nodiscard]] inline std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> found;
    const CPLStringList names(VSIReadDir(folder.c_str()));
    for (int i = 0; i < names.Count(); ++i)
        if (const std::string name = names[i]; name != "." && name != "..")
            found.push_back(name);
    return found;
}

/// Private folder in /vsimem/ for trials. Its name contains the address of this object, which is unique in
/// the process.
class VsimemFolder {
  public:
    VsimemFolder() : path_("/vsimem/d2b_probe_" + std::to_string(reinterpret_cast<std::uintptr_t>(this))) {
        VSIMkdir(path_.c_str(), 0755);
    }
    VsimemFolder(const VsimemFolder&) = delete;
    VsimemFolder& operator=(const VsimemFolder&) = delete;
    ~VsimemFolder() { VSIRmdirRecursive(path_.c_str()); }
    [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }

  private:
    std::string path_;
};

/// Returns the part of a destination's name by which a driver chooses its file layout. A stream is always one
/// file.
[[nodiscard]] std::string probe_name(GDALDriverH driver, const std::string& destination);

/// Creates an empty dataset with default options. @return null on failure
[[nodiscard]] reading::DatasetOwner create_trial(GDALDriverH driver, const std::string& file);

/// @return null if the driver creates none
OGRLayerH add_trial_layer(GDALDatasetH dataset, const char* name, OGRSpatialReferenceH srs);

/// Adds a small triangle. @param place its first vertex @return true if the driver accepts it
bool add_trial_feature(OGRLayerH layer, const Position& place);

/// True if the driver metadata have YES for a capability.
[[nodiscard]] bool has_capability(GDALDriverH driver, const char* capability);

/// True if the dataset has transactions of its own, not emulated by copies.
[[nodiscard]] bool has_native_transactions(GDALDatasetH dataset);

/// OGR driver that can create layers, and properties of its datasets at one destination.
struct VectorFormat {
    GDALDriverH driver = nullptr;
    std::string name;              ///< short name, e.g. "GPKG"
    bool multiple_layers = false;  ///< a dataset at this destination can hold both of our layers
    bool transactions = false;     ///< native transactions, not emulated by copies
    bool preserves_crs = true;
    bool folder = false;     ///< a dataset at this destination is a folder of files
    bool in_memory = false;  ///< the driver writes files of virtual file systems, too
    /// Suffixes of the files of a dataset here, from the first dot on; none for a folder.
    std::vector<std::string> suffixes;
    /// Stems of files in a folder that belong to no layer of ours, such as "doc" of a folder of KML, which
    /// lists the others.
    std::vector<std::string> indices;
};

/// Selects a format by -f, or by the extension or prefix of the destination; the first registered driver,
/// like ogr2ogr. @throws OptionError listing usable formats; also for vector tiles, because they do not
/// preserve geometries
[[nodiscard]] VectorFormat format_for(const WriteOptions& options);

/// Opens a dataset with this driver only. @param access GDAL_OF_READONLY or GDAL_OF_UPDATE @return null on
/// failure
reading::DatasetOwner open_dataset(const VectorFormat& format, const std::string& path, unsigned access);

/// True if the destination is a pipe or a device, which is written sequentially and cannot be read back.
[[nodiscard]] bool is_stream(const std::string& destination);

/// True if the driver takes the destination for a connection to a database or service, e.g. "PG:dbname=city".
[[nodiscard]] bool is_connection(GDALDriverH driver, const std::string& destination);

/// True if the driver has a layer creation option of this name.
[[nodiscard]] bool has_layer_option(GDALDriverH driver, const std::string& name);

}  // namespace d2b::writing
