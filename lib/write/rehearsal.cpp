#include "write/rehearsal.hpp"

#include <filesystem>

#include <cpl_string.h>

#include "dem2buildings/error.hpp"
#include "write/config_option.hpp"
#include "write/dataset_writer.hpp"
#include "write/reserved_names.hpp"
#include "write/staging.hpp"
#include "write/trial_dataset.hpp"

namespace d2b {

namespace {

/// Other programs look for fields by these names; case does not count.
void refuse_cut_names(const std::string& destination, const DatasetWriter& writer,
                      std::span<const LayerSpec> layers) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const std::vector<std::string> columns = writer.columns(i);
        for (std::size_t k = 0; k < columns.size(); ++k)
            if (const std::string& name = layers[i].fields[k].name; !EQUAL(columns[k].c_str(), name.c_str()))
                throw OptionError("-fields: \"" + destination + "\" would hold a field " + columns[k] +
                                  " in place of " + name +
                                  ", which no other program finds; write a GeoPackage.");
    }
}

struct Rehearsal {
    const Destination& destination;
    const VectorFormat& format;
    const WriteOptions& options;
    std::span<const LayerSpec> layers;
    const std::string& crs_wkt;

    /// @param folder with a slash
    void in(const std::string& folder) const {
        const std::string file = std::filesystem::path(destination.path).filename().string();
        DatasetWriter writer({destination.name, folder}, format, options);
        writer.begin(folder + (file.empty() ? "trial" : file), DatasetWriter::Mode::create, layers,
                     {crs_wkt, {}});
        if (options.fields != FieldNames::own)
            refuse_cut_names(destination.name, writer, layers);
    }
};

std::string with_advice(std::string sentence, const WriteOptions& options) {
    const bool own =
        options.layer_options.empty() && options.dataset_options.empty() && options.layer_name.empty();
    sentence.pop_back();
    return sentence +
           (own ? "; write another format, such as GeoPackage."
                : "; see whether -nln, -lco or -dsco ask for what cannot be, or write another format, "
                  "such as GeoPackage.");
}

}  // namespace

void rehearse(const Destination& destination, const VectorFormat& format, const WriteOptions& options,
              std::span<const LayerSpec> layers, const std::string& crs_wkt) {
    refuse_reserved_names(format, options, layers);
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    const ConfigOption no_waiting("OGR_SQLITE_SYNCHRONOUS", "OFF");
    const Rehearsal rehearsal{destination, format, options, layers, crs_wkt};
    try {
        try {
            const MemoryFolder memory;
            rehearsal.in(memory.file(""));
        } catch (const OutputError&) {
            if (!destination.local)
                throw;
            const Staging beside(destination.name, destination.path);
            rehearsal.in(beside.folder().string() + "/");
        }
    } catch (const OutputError& error) {
        throw OutputError(with_advice(error.what(), options));
    }
}

}  // namespace d2b
