#include "write/vector/layer_parts.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "read/gdal_setup.hpp"
#include "write/staging.hpp"
#include "write/vector/layer_names.hpp"
#include "write/vector/vector_format.hpp"
#include "write/xml_text.hpp"

namespace d2b::writing {
namespace {

class PartSink final : public FileSink<FeatureSink> {
  public:
    PartSink(WriteOptions options, std::int64_t part, Callbacks callbacks);

    void begin(std::span<const LayerSpec> layers, const Provenance& provenance) override;
    void add(std::size_t layer, const Feature& feature) override;
    void prepare(CommitList& commit) override;
    [[nodiscard]] Layers layers(std::optional<Layers> asked) const override;
    [[nodiscard]] std::string layer_name(LayerRole role, Layers layers) const override;
    [[nodiscard]] std::vector<std::string> take_warnings() override;

  private:
    [[nodiscard]] FeatureSink& sink(std::size_t layer);

    WriteOptions options_;
    VectorFormat format_;
    std::int64_t part_;
    Callbacks callbacks_;
    std::vector<LayerSpec> specs_;
    Provenance provenance_;
    std::vector<std::unique_ptr<FeatureSink>> sinks_;  ///< null if the layer has no features yet
};

PartSink::PartSink(WriteOptions options, std::int64_t part, Callbacks callbacks)
    : options_(std::move(options)),
      format_(format_for(options_)),
      part_(part),
      callbacks_(std::move(callbacks)) {}

void PartSink::begin(std::span<const LayerSpec> layers, const Provenance& provenance) {
    specs_.assign(layers.begin(), layers.end());
    provenance_ = provenance;
    sinks_.resize(specs_.size());
    // Part 0 creates all layers, because they must exist even if nothing was found.
    for (std::size_t layer = 0; part_ == 0 && layer < specs_.size(); ++layer)
        (void)sink(layer);
}

FeatureSink& PartSink::sink(std::size_t layer) {
    std::unique_ptr<FeatureSink>& sink = sinks_[layer];
    if (sink)
        return *sink;
    const std::filesystem::path folder = std::filesystem::path(options_.destination) / specs_[layer].name;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw OutputError("\"" + folder.string() + "\" cannot be made: " + error.message() +
                          "; free some space, or allow writing to it.");
    // Keep only the options that affect how a layer is written.
    WriteOptions options;
    options.format = options_.format;
    options.destination = (folder / (std::to_string(part_) + ".fgb")).string();
    options.overwrite = true;
    options.layers = Layers::buildings;
    options.layer_options = options_.layer_options;
    options.dataset_options = options_.dataset_options;
    sink = open_sink(options, callbacks_);
    sink->begin({&specs_[layer], 1}, provenance_);
    return *sink;
}

void PartSink::add(std::size_t layer, const Feature& feature) {
    sink(layer).add(0, feature);
}

void PartSink::prepare(CommitList& commit) {
    for (const auto& sink : sinks_)
        if (sink)
            sink->prepare(commit);
}

Layers PartSink::layers(std::optional<Layers> asked) const {
    return resolve_layers(options_, asked, format_);
}

std::string PartSink::layer_name(LayerRole role, Layers layers) const {
    return name_of(options_, format_, role, layers);
}

std::vector<std::string> PartSink::take_warnings() {
    std::vector<std::string> all;
    for (const auto& sink : sinks_)
        if (sink)
            for (std::string& warning : sink->take_warnings())
                all.push_back(std::move(warning));
    return all;
}

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

std::string vrt_text(const LayerMosaic& mosaic) {
    const LayerSpec& spec = mosaic.spec;
    const std::string name = xml_text(spec.name);
    std::string text = "<OGRVRTDataSource>\n  <OGRVRTUnionLayer name=\"" + name + "\">\n";
    for (const std::int64_t part : mosaic.parts) {
        const std::string number = std::to_string(part);
        text += "    <OGRVRTLayer name=\"" + number + "\"><SrcDataSource relativeToVRT=\"1\" shared=\"0\">" +
                name + "/" + number + ".fgb</SrcDataSource><SrcLayer>" + name + "</SrcLayer></OGRVRTLayer>\n";
    }
    text += xml_element(4, "GeometryType", vrt_geometry(spec));
    if (!mosaic.crs_wkt.empty())
        text += xml_element(4, "LayerSRS", mosaic.crs_wkt);
    for (const FieldSpec& field : spec.fields)
        text += "    <Field name=\"" + xml_text(field.name) + "\" type=\"" + vrt_type(field.type) + "\"/>\n";
    text += xml_element(4, "FeatureCount", std::to_string(mosaic.features));
    if (mosaic.features > 0)
        text += xml_element(4, "ExtentXMin", number_text(mosaic.least.x)) +
                xml_element(4, "ExtentYMin", number_text(mosaic.least.y)) +
                xml_element(4, "ExtentXMax", number_text(mosaic.most.x)) +
                xml_element(4, "ExtentYMax", number_text(mosaic.most.y));
    return text + "  </OGRVRTUnionLayer>\n</OGRVRTDataSource>\n";
}

}  // namespace

std::unique_ptr<FeatureSink> open_part_sink(const WriteOptions& options, std::int64_t part,
                                            const Callbacks& callbacks) {
    return std::make_unique<PartSink>(options, part, callbacks);
}

bool writes_parts(const WriteOptions& options) {
    if (options.format.empty() || options.destination.empty() || options.destination.starts_with("/vsi"))
        return false;
    reading::register_formats();
    const VectorFormat format = format_for(options);
    return format.name == "FlatGeobuf" && format.folder;
}

std::unique_ptr<PendingResult> prepare_layer_mosaic(const WriteOptions& options, const LayerMosaic& mosaic) {
    return prepare_text_file(std::filesystem::path(options.destination) / (mosaic.spec.name + ".vrt"),
                             vrt_text(mosaic));
}

}  // namespace d2b::writing
