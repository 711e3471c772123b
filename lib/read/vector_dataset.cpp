#include "read/vector_dataset.hpp"

#include <array>
#include <cstddef>
#include <memory>

#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"

namespace d2b {

DatasetOwner open_vector_dataset(const std::string& path, Context& context) {
    const GdalMessages messages;
    DatasetOwner dataset(GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                    nullptr, nullptr, nullptr));
    if (!dataset)
        throw InputError("'" + path + "' cannot be opened as a vector dataset: " + messages.reason_for(path) +
                         ".");
    messages.pass_all(context);
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

std::string wkt_of_layer(OGRLayerH layer) {
    const OGRSpatialReferenceH crs = OGR_L_GetSpatialRef(layer);
    if (crs == nullptr)
        return {};
    constexpr std::array<const char*, 3> options{"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
    char* text = nullptr;
    const OGRErr status = OSRExportToWktEx(crs, &text, options.data());
    const std::unique_ptr<char, GdalRelease<void*, VSIFree>> owner(text);
    return status == OGRERR_NONE && text != nullptr ? text : "";
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
