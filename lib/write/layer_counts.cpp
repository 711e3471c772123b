#include "write/layer_counts.hpp"

#include "core/error.hpp"

namespace d2b {

namespace {

std::string sql_name(std::string name) {
    for (auto at = name.find('"'); at != std::string::npos; at = name.find('"', at + 2))
        name.insert(at, 1, '"');
    name.insert(0, 1, '"');
    return name + '"';
}

/// -1 where the database does not answer.
std::int64_t count_rows(GDALDatasetH dataset, const std::string& layer) {
    const std::string sql = "SELECT COUNT(*) AS n FROM " + sql_name(layer);
    OGRLayerH result = GDALDatasetExecuteSQL(dataset, sql.c_str(), nullptr, nullptr);
    if (result == nullptr)
        return -1;
    std::int64_t found = -1;
    {
        const FeatureHandle row(OGR_L_GetNextFeature(result));
        if (row)
            found = OGR_F_GetFieldAsInteger64(row.get(), 0);
    }
    GDALDatasetReleaseResultSet(dataset, result);
    return found;
}

/// A file that is a layer may call it as it likes.
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

}  // namespace

void check_counts(const WriteTarget& target, GDALDatasetH dataset, const LayerCounts& counts) {
    for (const auto& [name, expected] : counts) {
        OgrCall call(target);
        const std::int64_t found = count_rows(dataset, name);
        call.check(found >= 0, "counting the features of layer \"" + name + "\"");
        if (found != expected)
            throw wrong_count(target, name, found, expected);
    }
}

void verify_counts(const WriteTarget& target, const VectorFormat& format, const std::string& path,
                   const LayerCounts& counts) {
    if (GDALGetMetadataItem(format.driver, GDAL_DCAP_OPEN, nullptr) == nullptr)
        return;
    OgrCall call(target);
    const DatasetHandle dataset = open_dataset(format, path, GDAL_OF_READONLY);
    call.check(dataset != nullptr, "reading the result back");
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto& [name, expected] = counts[i];
        const std::int64_t found = count_layer(dataset.get(), name, i);
        if (found != expected)
            throw wrong_count(target, name, found, expected);
    }
}

}  // namespace d2b
