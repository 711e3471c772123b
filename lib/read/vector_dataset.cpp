#include "read/vector_dataset.hpp"

#include <cstddef>

#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"

namespace d2b {

DatasetOwner open_vector_dataset(const std::string& path, const std::string& complaint, Warnings& warnings) {
    const GdalMessages messages;
    DatasetOwner dataset = open_gated(path, GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR);
    if (!dataset)
        throw InputError(complaint + ": " + messages.reason_for(path) + ".");
    messages.pass_all(warnings);
    return dataset;
}

std::vector<std::string> geometry_layers(GDALDatasetH dataset) {
    std::vector<std::string> names;
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset); ++i) {
        const OGRLayerH layer = GDALDatasetGetLayer(dataset, i);
        if (OGR_L_GetGeomType(layer) != wkbNone)
            names.emplace_back(OGR_L_GetName(layer));
    }
    return names;
}

OGRLayerH pick_layer(GDALDatasetH dataset, const LayerChoice& choice) {
    const std::vector<std::string> names = geometry_layers(dataset);
    if (names.empty())
        throw InputError("'" + choice.dataset +
                         "' has no layer with geometries; give a dataset with polygons.");
    if (!choice.layer.empty()) {
        if (const OGRLayerH layer = GDALDatasetGetLayerByName(dataset, choice.layer.c_str()))
            return layer;
        throw OptionError("'" + choice.dataset + "' has no layer '" + choice.layer + "'; it has " +
                          quoted_names(names) + ".");
    }
    for (const std::string& name : choice.defaults)
        if (const OGRLayerH layer = GDALDatasetGetLayerByName(dataset, name.c_str()))
            return layer;
    return GDALDatasetGetLayerByName(dataset, names.front().c_str());
}

void for_each_geometry(OGRLayerH layer, const std::string& what, Warnings& warnings,
                       const std::function<void(OGRFeatureH, OGRGeometryH)>& visit) {
    const GdalMessages messages;
    OGR_L_ResetReading(layer);
    while (const FeatureOwner feature{OGR_L_GetNextFeature(layer)})
        if (OGRGeometryH const geometry = OGR_F_GetGeometryRef(feature.get());
            geometry != nullptr && OGR_G_IsEmpty(geometry) == FALSE)
            visit(feature.get(), geometry);
    if (messages.failed())
        throw InputError(what + " cannot be read: " + messages.reason() + ".");
    messages.pass_warnings(warnings);
}

std::string quoted_names(std::span<const std::string> names) {
    constexpr std::size_t most = 20;
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < most; ++i) {
        const bool last = i + 1 == names.size();
        text += (i == 0 ? "'" : last ? " and '" : ", '") + names[i] + "'";
    }
    return names.size() > most ? text + " and others" : text;
}

}  // namespace d2b
