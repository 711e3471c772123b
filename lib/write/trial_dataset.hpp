#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <cpl_string.h>
#include <cpl_vsi.h>

#include "dem2buildings/sinks.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// A folder of /vsimem/ of its own, for trials; the address of a living object is unique in the process.
class MemoryFolder {
  public:
    MemoryFolder() : path_("/vsimem/d2b_probe_" + std::to_string(reinterpret_cast<std::uintptr_t>(this))) {
        VSIMkdir(path_.c_str(), 0755);
    }
    MemoryFolder(const MemoryFolder&) = delete;
    MemoryFolder& operator=(const MemoryFolder&) = delete;
    ~MemoryFolder() { VSIRmdirRecursive(path_.c_str()); }
    /// Of the files called probe.* alone: a driver may have put others there.
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

/// The part of a destination's name that decides how a driver lays its files out. A stream is always one
/// file.
[[nodiscard]] std::string trial_name(GDALDriverH driver, const std::string& destination);

/// @return null where the driver makes none
OGRLayerH add_trial_layer(GDALDatasetH dataset, const char* name, OGRSpatialReferenceH srs);

/// A small triangle. @param place its first corner @return whether the driver takes it
bool add_trial_feature(OGRLayerH layer, const Position& place);

/// By its driver alone. @return null where it cannot
[[nodiscard]] DatasetOwner reopen_trial(GDALDriverH driver, const std::string& file);

/// Whether the driver says YES to a capability.
[[nodiscard]] bool says_yes(GDALDriverH driver, const char* capability);

}  // namespace d2b
