#include "write/layer_counts.hpp"

#include <algorithm>

#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "write/sql.hpp"

namespace d2b {

namespace {

/// Falls back to the index, because a file that is one layer may have any layer name.
std::int64_t count_layer(GDALDatasetH dataset, const std::string& name, std::size_t index) {
    OGRLayerH layer = GDALDatasetGetLayerByName(dataset, name.c_str());
    if (layer == nullptr)
        layer = GDALDatasetGetLayer(dataset, static_cast<int>(index));
    return layer == nullptr ? 0 : OGR_L_GetFeatureCount(layer, TRUE);
}

OutputError wrong_count(const WriteTarget& target, const std::string& layer, std::int64_t found,
                        std::int64_t expected) {
    return OutputError("Cannot write \"" + target.name + "\": layer \"" + layer + "\" holds " +
                       std::to_string(found) + " features when read back instead of " +
                       std::to_string(expected) + ".");
}

/// True for the empty file of a GeoJSON sequence without objects, which no driver recognizes.
bool is_empty_sequence(const std::string& path, const LayerCounts& counts) {
    VSIStatBufL status{};
    return std::ranges::all_of(counts, [](const auto& layer) { return layer.second == 0; }) &&
           VSIStatL(path.c_str(), &status) == 0 && status.st_size == 0;
}

}  // namespace

std::int64_t count_rows(const WriteTarget& target, GDALDatasetH dataset, const std::string& layer) {
    OgrCall call(target);
    const auto found = sql_value(dataset, "SELECT COUNT(*) AS n FROM " + sql_name(layer));
    call.check(found.has_value(), "counting the features of layer \"" + layer + "\"");
    return std::stoll(*found);
}

void check_counts(const WriteTarget& target, GDALDatasetH dataset, const LayerCounts& counts) {
    for (const auto& [name, expected] : counts) {
        const std::int64_t found = count_rows(target, dataset, name);
        if (found != expected)
            throw wrong_count(target, name, found, expected);
    }
}

void verify_counts(const WriteTarget& target, const VectorFormat& format, const std::string& path,
                   const LayerCounts& counts) {
    if (GDALGetMetadataItem(format.driver, GDAL_DCAP_OPEN, nullptr) == nullptr)
        return;
    OgrCall call(target);
    const DatasetOwner dataset = open_dataset(format, path, GDAL_OF_READONLY);
    if (!dataset && is_empty_sequence(path, counts))
        return;
    call.check(dataset != nullptr, "reading the result back");
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto& [name, expected] = counts[i];
        const std::int64_t found = count_layer(dataset.get(), name, i);
        if (found != expected)
            throw wrong_count(target, name, found, expected);
    }
}

}  // namespace d2b
