#include "read/original_layer.hpp"

#include <cstdint>
#include <string_view>

#include <cpl_string.h>

#include "core/byte_stream.hpp"

namespace d2b::reading {
namespace {

enum class FieldState : std::uint8_t { unset, null, value };

OGRFieldType type_of(OGRFeatureH feature, int field) {
    return OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field));
}

/// True for types whose values in OGRField hold no pointers.
bool is_plain(OGRFieldType type) {
    return type == OFTInteger || type == OFTInteger64 || type == OFTReal || type == OFTDate ||
           type == OFTTime || type == OFTDateTime;
}

template <typename Value>
void put_values(ByteWriter& writer, const Value* values, int count) {
    writer.put_list(std::vector<Value>(values, values + count));
}

void put_value(ByteWriter& writer, OGRFeatureH feature, int field) {
    const OGRFieldType type = type_of(feature, field);
    int count = 0;
    if (is_plain(type)) {
        writer.put(*OGR_F_GetRawFieldRef(feature, field));
    } else if (type == OFTIntegerList) {
        const int* values = OGR_F_GetFieldAsIntegerList(feature, field, &count);
        put_values(writer, values, count);
    } else if (type == OFTInteger64List) {
        const GIntBig* values = OGR_F_GetFieldAsInteger64List(feature, field, &count);
        put_values(writer, values, count);
    } else if (type == OFTRealList) {
        const double* values = OGR_F_GetFieldAsDoubleList(feature, field, &count);
        put_values(writer, values, count);
    } else if (type == OFTBinary) {
        const GByte* values = OGR_F_GetFieldAsBinary(feature, field, &count);
        put_values(writer, values, count);
    } else if (type == OFTStringList) {
        char** texts = OGR_F_GetFieldAsStringList(feature, field);
        count = CSLCount(texts);
        writer.put(count);
        for (int i = 0; i < count; ++i)
            writer.put_text(texts[i]);
    } else {
        writer.put_text(OGR_F_GetFieldAsString(feature, field));
    }
}

void take_value(ByteReader& reader, OGRFeatureH feature, int field) {
    const OGRFieldType type = type_of(feature, field);
    if (is_plain(type)) {
        const auto value = reader.take<OGRField>();
        OGR_F_SetFieldRaw(feature, field, &value);
    } else if (type == OFTIntegerList) {
        const auto values = reader.take_list<int>();
        OGR_F_SetFieldIntegerList(feature, field, static_cast<int>(values.size()), values.data());
    } else if (type == OFTInteger64List) {
        const auto values = reader.take_list<GIntBig>();
        OGR_F_SetFieldInteger64List(feature, field, static_cast<int>(values.size()), values.data());
    } else if (type == OFTRealList) {
        const auto values = reader.take_list<double>();
        OGR_F_SetFieldDoubleList(feature, field, static_cast<int>(values.size()), values.data());
    } else if (type == OFTBinary) {
        const auto values = reader.take_list<GByte>();
        OGR_F_SetFieldBinary(feature, field, static_cast<int>(values.size()), values.data());
    } else if (type == OFTStringList) {
        CPLStringList texts;
        for (int left = reader.take<int>(); left > 0; --left)
            texts.AddString(reader.take_text().c_str());
        OGR_F_SetFieldStringList(feature, field, texts.List());
    } else {
        OGR_F_SetFieldString(feature, field, reader.take_text().c_str());
    }
}

}  // namespace

OgrOriginalLayer::OgrOriginalLayer(OGRLayerH layer)
    : definition_(OGR_FD_Create(OGR_L_GetName(layer))),
      fid_column_(OGR_L_GetFIDColumn(layer)),
      geometry_column_(OGR_L_GetGeometryColumn(layer)) {
    OGR_FD_Reference(definition_.get());
    const OGRFeatureDefnH own = OGR_L_GetLayerDefn(layer);
    OGR_FD_SetGeomType(definition_.get(), OGR_L_GetGeomType(layer));
    for (int i = 0; i < OGR_FD_GetFieldCount(own); ++i) {
        OGR_FD_AddFieldDefn(definition_.get(), OGR_FD_GetFieldDefn(own, i));
        // The destination is tried with an empty feature, and has no domains.
        OGRFieldDefnH const field = OGR_FD_GetFieldDefn(definition_.get(), i);
        OGR_Fld_SetNullable(field, TRUE);
        OGR_Fld_SetDomainName(field, nullptr);
    }
}

std::vector<std::string> OgrOriginalLayer::field_names() const {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(OGR_FD_GetFieldCount(definition_.get())));
    for (int i = 0; i < OGR_FD_GetFieldCount(definition_.get()); ++i)
        names.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition_.get(), i)));
    return names;
}

std::vector<std::byte> OgrOriginalLayer::encode(OGRFeatureH feature, OGRGeometryH geometry) const {
    ByteWriter writer;
    writer.put(static_cast<std::int64_t>(OGR_F_GetFID(feature)));
    const char* const style = OGR_F_GetStyleString(feature);
    writer.put_text(style == nullptr ? "" : style);
    std::vector<std::byte> wkb;
    if (geometry != nullptr) {
        wkb.resize(static_cast<std::size_t>(OGR_G_WkbSize(geometry)));
        OGR_G_ExportToIsoWkb(geometry, wkbNDR, reinterpret_cast<unsigned char*>(wkb.data()));
    }
    writer.put_list(wkb);
    for (int i = 0; i < OGR_FD_GetFieldCount(definition_.get()); ++i) {
        const FieldState state = OGR_F_IsFieldSet(feature, i) == FALSE    ? FieldState::unset
                                 : OGR_F_IsFieldNull(feature, i) != FALSE ? FieldState::null
                                                                          : FieldState::value;
        writer.put(state);
        if (state == FieldState::value)
            put_value(writer, feature, i);
    }
    return {writer.bytes().begin(), writer.bytes().end()};
}

FeatureOwner OgrOriginalLayer::decode(std::span<const std::byte> bytes) const {
    ByteReader reader(std::vector<std::byte>(bytes.begin(), bytes.end()));
    FeatureOwner feature(OGR_F_Create(definition_.get()));
    OGR_F_SetFID(feature.get(), reader.take<std::int64_t>());
    if (const std::string style = reader.take_text(); !style.empty())
        OGR_F_SetStyleString(feature.get(), style.c_str());
    if (const auto wkb = reader.take_list<std::byte>(); !wkb.empty()) {
        OGRGeometryH geometry = nullptr;
        if (OGR_G_CreateFromWkb(wkb.data(), nullptr, &geometry, static_cast<int>(wkb.size())) == OGRERR_NONE)
            OGR_F_SetGeometryDirectly(feature.get(), geometry);
    }
    for (int i = 0; i < OGR_FD_GetFieldCount(definition_.get()); ++i) {
        const auto state = reader.take<FieldState>();
        if (state == FieldState::null)
            OGR_F_SetFieldNull(feature.get(), i);
        else if (state == FieldState::value)
            take_value(reader, feature.get(), i);
    }
    return feature;
}

}  // namespace d2b::reading
