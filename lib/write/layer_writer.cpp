#include "write/layer_writer.hpp"

#include <algorithm>
#include <utility>

#include "dem2buildings/error.hpp"
#include "write/layer_create.hpp"
#include "write/layer_fit.hpp"

namespace d2b {

namespace {

std::int64_t largest_fid(OGRLayerH layer) {
    std::int64_t largest = 0;
    OGR_L_ResetReading(layer);
    while (const FeatureOwner feature{OGR_L_GetNextFeature(layer)})
        largest = std::max<std::int64_t>(largest, OGR_F_GetFID(feature.get()));
    return largest;
}

}  // namespace

LayerWriter::LayerWriter(OGRLayerH layer, const LayerSpec& spec, const LayerSetting& setting,
                         std::vector<int> fields)
    : layer_(layer),
      name_(OGR_L_GetName(layer)),
      target_(&setting.target),
      fields_(std::move(fields)),
      has_geometry_(OGR_FD_GetGeomFieldCount(OGR_L_GetLayerDefn(layer)) > 0),
      feature_(OGR_F_Create(OGR_L_GetLayerDefn(layer))),
      wkb_(spec.with_z, wkbFlatten(OGR_L_GetGeomType(layer)) == wkbMultiSurface) {}

LayerWriter LayerWriter::create(GDALDatasetH dataset, const LayerSpec& spec, const LayerSetting& setting) {
    OGRLayerH layer = create_layer(dataset, spec, setting);
    LayerWriter writer(layer, spec, setting, create_fields(layer, spec, setting));
    writer.is_new_ = true;
    return writer;
}

std::vector<std::string> LayerWriter::columns() const {
    std::vector<std::string> names;
    for (const int field : fields_)
        names.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer_), field)));
    return names;
}

LayerWriter LayerWriter::adopt(OGRLayerH layer, const LayerSpec& spec, const LayerSetting& setting) {
    LayerWriter writer(layer, spec, setting, fitting_fields(layer, spec, setting));
    OgrCall call(setting.target);
    writer.expected_ = OGR_L_GetFeatureCount(layer, TRUE);
    // This driver sorts by FID, which it reads from a field "id", and assigns free ones to new features.
    if (setting.format.name == "GeoJSON")
        writer.next_fid_ = largest_fid(layer) + 1;
    call.check(writer.expected_ >= 0, "counting the features of layer \"" + writer.name_ + "\"");
    return writer;
}

void LayerWriter::index_at_end(GDALDatasetH dataset) {
    index_ = SpatialIndex::begin(dataset, layer_, *target_);
}

void LayerWriter::finish() {
    if (index_)
        index_->finish();
    index_.reset();
}

void LayerWriter::set(int field, const FieldValue& value) {
    OGRFeatureH feature = feature_.get();
    if (const auto* integer = std::get_if<std::int64_t>(&value))
        OGR_F_SetFieldInteger64(feature, field, *integer);
    else if (const auto* real = std::get_if<double>(&value))
        OGR_F_SetFieldDouble(feature, field, *real);
    else if (const auto* text = std::get_if<std::string>(&value))
        OGR_F_SetFieldString(feature, field, text->c_str());
    else
        OGR_F_SetFieldNull(feature, field);
}

std::string LayerWriter::text_of(const Feature& feature) const {
    const auto* id = feature.values.empty() ? nullptr : std::get_if<std::int64_t>(&feature.values.front());
    return (id != nullptr ? "feature " + std::to_string(*id) : std::string("a feature")) + " of layer \"" +
           name_ + "\"";
}

void LayerWriter::add(const Feature& feature) {
    if (feature.values.size() != fields_.size())
        throw OutputError("Cannot write \"" + target_->name + "\": a feature of layer \"" + name_ +
                          "\" has " + std::to_string(feature.values.size()) + " values for " +
                          std::to_string(fields_.size()) + " fields.");
    OgrCall call(*target_);
    OGR_F_SetFID(feature_.get(), next_fid_ == OGRNullFID ? OGRNullFID : next_fid_++);
    for (std::size_t i = 0; i < fields_.size(); ++i)
        set(fields_[i], feature.values[i]);
    bool done = true;
    if (has_geometry_) {
        const auto bytes = wkb_.encode(feature);
        OGRGeometryH geometry = nullptr;
        done = OGR_G_CreateFromWkb(bytes.data(), nullptr, &geometry, static_cast<int>(bytes.size())) ==
                   OGRERR_NONE &&
               OGR_F_SetGeometryDirectly(feature_.get(), geometry) == OGRERR_NONE;
        wkb_.forget_large();  // a contour may fill the raster, and the driver makes its own copies
    }
    done = done && OGR_L_CreateFeature(layer_, feature_.get()) == OGRERR_NONE;
    if (has_geometry_)
        OGR_F_SetGeometryDirectly(feature_.get(), nullptr);
    if (!done || !call.succeeded())
        call.fail("writing " + text_of(feature));
    call.pass_warnings();
    if (index_)
        index_->add(OGR_F_GetFID(feature_.get()), feature);
    ++expected_;
}

}  // namespace d2b
