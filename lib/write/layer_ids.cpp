#include "write/layer_ids.hpp"

#include <algorithm>
#include <array>

#include "dem2buildings/error.hpp"
#include "write/layer_fit.hpp"
#include "write/sql.hpp"

namespace d2b {

namespace {

int id_field(OGRLayerH layer, const LayerSpec& spec) {
    return spec.fields.empty()
               ? -1
               : OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(layer), spec.fields.front().name.c_str());
}

std::int64_t largest_in_file(OGRLayerH layer, int field) {
    std::array<const char*, 3> ignored{"OGR_GEOMETRY", "OGR_STYLE", nullptr};
    OGR_L_SetIgnoredFields(layer, ignored.data());
    OGR_L_ResetReading(layer);
    std::int64_t largest = 0;
    while (const FeatureOwner feature{OGR_L_GetNextFeature(layer)})
        largest = std::max<std::int64_t>(largest, OGR_F_GetFieldAsInteger64(feature.get(), field));
    return largest;
}

}  // namespace

std::int64_t largest_id(const WriteTarget& target, GDALDatasetH database, std::span<const LayerSpec> layers) {
    std::int64_t largest = 0;
    for (const LayerSpec& spec : layers) {
        OGRLayerH layer = GDALDatasetGetLayerByName(database, spec.name.c_str());
        const int field = layer == nullptr ? -1 : id_field(layer, spec);
        if (field < 0)
            continue;
        const std::string name = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer), field));
        OgrCall call(target);
        const auto found =
            sql_value(database, "SELECT COALESCE(MAX(CAST(" + sql_name(name) + " AS BIGINT)), 0) AS n FROM " +
                                    sql_name(OGR_L_GetName(layer)));
        call.check(found.has_value(), "reading the numbers of layer \"" + spec.name + "\"");
        largest = std::max<std::int64_t>(largest, std::stoll(*found));
    }
    return largest;
}

std::int64_t largest_id(const WriteTarget& target, const VectorFormat& format, const std::string& path,
                        std::span<const LayerSpec> layers) {
    OgrCall call(target);
    const DatasetOwner dataset = open_dataset(format, path, GDAL_OF_READONLY);
    std::int64_t largest = 0;
    for (const LayerSpec& spec : layers) {
        OGRLayerH layer = dataset ? layer_called(dataset.get(), format, spec.name) : nullptr;
        const int field = layer == nullptr ? -1 : id_field(layer, spec);
        if (field >= 0)
            largest = std::max(largest, largest_in_file(layer, field));
    }
    call.check(dataset != nullptr, "reading the numbers of its features");
    return largest;
}

}  // namespace d2b
