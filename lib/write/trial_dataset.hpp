#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <cpl_string.h>
#include <cpl_vsi.h>

#include "dem2buildings/sinks.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// Private folder in /vsimem/ for trials. Its name contains the address of this object, which is unique in
/// the process.
class MemoryFolder {
  public:
    MemoryFolder() : path_("/vsimem/d2b_probe_" + std::to_string(reinterpret_cast<std::uintptr_t>(this))) {
        VSIMkdir(path_.c_str(), 0755);
    }
    MemoryFolder(const MemoryFolder&) = delete;
    MemoryFolder& operator=(const MemoryFolder&) = delete;
    ~MemoryFolder() { VSIRmdirRecursive(path_.c_str()); }
    /// Returns the suffixes of files named probe.*, because a driver may add other files.
    [[nodiscard]] std::vector<std::string> suffixes() const {
        std::vector<std::string> found;
        const CPLStringList names(VSIReadDir(path_.c_str()));
        for (int i = 0; i < names.Count(); ++i) {
            const std::string name = names[i];
            if (name.starts_with("probe."))
                found.push_back(name.substr(5));
        }
        return found;
    }
    [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }

  private:
    std::string path_;
};

/// Returns the part of a destination's name by which a driver chooses its file layout. A stream is always one
/// file.
[[nodiscard]] std::string trial_name(GDALDriverH driver, const std::string& destination);

/// @return null if the driver creates none
OGRLayerH add_trial_layer(GDALDatasetH dataset, const char* name, OGRSpatialReferenceH srs);

/// Adds a small triangle. @param place its first vertex @return true if the driver accepts it
bool add_trial_feature(OGRLayerH layer, const Position& place);

/// Opens the file with this driver only. @return null on failure
[[nodiscard]] DatasetOwner reopen_trial(GDALDriverH driver, const std::string& file);

/// True if the driver metadata have YES for a capability.
[[nodiscard]] bool says_yes(GDALDriverH driver, const char* capability);

}  // namespace d2b
