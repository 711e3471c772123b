#include "write/layer_mosaic.hpp"

#include <filesystem>

#include "core/number_text.hpp"
#include "write/small_file.hpp"
#include "write/xml_text.hpp"

namespace d2b {
namespace {

/// Returns the geometry type as spelled in a VRT. FlatGeobuf keeps arcs.
std::string vrt_geometry(const LayerSpec& spec) {
    if (spec.points)
        return "wkbPoint";
    const std::string type = spec.with_arcs ? "wkbMultiSurface" : "wkbMultiPolygon";
    return spec.with_z ? type + (spec.with_arcs ? "Z" : "25D") : type;
}

std::string vrt_type(FieldType type) {
    return type == FieldType::integer ? "Integer64" : type == FieldType::real ? "Real" : "String";
}

std::string vrt_element(const std::string& name, const std::string& text) {
    return "    <" + name + ">" + xml_text(text) + "</" + name + ">\n";
}

std::string vrt_text(const LayerMosaic& mosaic) {
    const LayerSpec& spec = mosaic.spec;
    const std::string name = xml_text(spec.name);
    std::string text = "<OGRVRTDataSource>\n  <OGRVRTUnionLayer name=\"" + name + "\">\n";
    for (const std::int64_t part : mosaic.parts) {
        const std::string number = std::to_string(part);
        text += "    <OGRVRTLayer name=\"" + number + "\"><SrcDataSource relativeToVRT=\"1\" shared=\"0\">" +
                name + "/" + number + ".fgb</SrcDataSource><SrcLayer>" + name + "</SrcLayer></OGRVRTLayer>\n";
    }
    text += vrt_element("GeometryType", vrt_geometry(spec));
    if (!mosaic.crs_wkt.empty())
        text += vrt_element("LayerSRS", mosaic.crs_wkt);
    for (const FieldSpec& field : spec.fields)
        text += "    <Field name=\"" + xml_text(field.name) + "\" type=\"" + vrt_type(field.type) + "\"/>\n";
    text += vrt_element("FeatureCount", std::to_string(mosaic.features));
    if (mosaic.features > 0)
        text += vrt_element("ExtentXMin", number_text(mosaic.least.x)) +
                vrt_element("ExtentYMin", number_text(mosaic.least.y)) +
                vrt_element("ExtentXMax", number_text(mosaic.most.x)) +
                vrt_element("ExtentYMax", number_text(mosaic.most.y));
    return text + "  </OGRVRTUnionLayer>\n</OGRVRTDataSource>\n";
}

}  // namespace

std::unique_ptr<PendingResult> prepare_layer_mosaic(const WriteOptions& options, const LayerMosaic& mosaic) {
    return prepare_small_file(std::filesystem::path(options.destination) / (mosaic.spec.name + ".vrt"),
                              vrt_text(mosaic));
}

}  // namespace d2b
