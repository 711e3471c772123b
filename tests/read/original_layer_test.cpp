#include "read/original_layer.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <ogr_api.h>

#include "read/gdal_handles.hpp"
#include "read/gdal_setup.hpp"

namespace d2b::reading {
namespace {

constexpr std::array types{OFTInteger,     OFTInteger64,     OFTReal,     OFTString,
                           OFTDate,        OFTTime,          OFTDateTime, OFTBinary,
                           OFTIntegerList, OFTInteger64List, OFTRealList, OFTStringList};

/// A layer in memory with a field of each type.
class OriginalLayers : public ::testing::Test {
  protected:
    void SetUp() override {
        start_gdal();
        GDALDriverH driver = GDALGetDriverByName("Memory");
        dataset_.reset(GDALCreate(driver != nullptr ? driver : GDALGetDriverByName("MEM"), "", 0, 0, 0,
                                  GDT_Unknown, nullptr));
        layer_ = GDALDatasetCreateLayer(dataset_.get(), "all", nullptr, wkbCurvePolygon, nullptr);
        for (const OGRFieldType type : types) {
            const GdalOwner<OGRFieldDefnH, OGR_Fld_Destroy> field(
                OGR_Fld_Create(OGR_GetFieldTypeName(type), type));
            OGR_L_CreateField(layer_, field.get(), TRUE);
        }
    }
    [[nodiscard]] FeatureOwner feature(std::int64_t fid) const {
        FeatureOwner made(OGR_F_Create(OGR_L_GetLayerDefn(layer_)));
        OGR_F_SetFID(made.get(), fid);
        return made;
    }
    [[nodiscard]] static std::string text(OGRFeatureH feature) {
        std::string all = std::to_string(OGR_F_GetFID(feature));
        for (int i = 0; i < OGR_F_GetFieldCount(feature); ++i)
            all += OGR_F_IsFieldSet(feature, i) == FALSE ? "|unset"
                   : OGR_F_IsFieldNull(feature, i) != FALSE
                       ? "|null"
                       : std::string("|") + OGR_F_GetFieldAsString(feature, i);
        if (OGRGeometryH geometry = OGR_F_GetGeometryRef(feature)) {
            char* wkt = nullptr;
            OGR_G_ExportToIsoWkt(geometry, &wkt);
            all += wkt;
            CPLFree(wkt);
        }
        const char* style = OGR_F_GetStyleString(feature);
        return all + (style == nullptr ? "" : style);
    }

    DatasetOwner dataset_;
    OGRLayerH layer_ = nullptr;
};

TEST_F(OriginalLayers, giveFeaturesBackWithAllValues) {
    const OgrOriginalLayer original(layer_);
    const FeatureOwner full = feature(17);
    OGR_F_SetFieldInteger(full.get(), 0, -7);
    OGR_F_SetFieldInteger64(full.get(), 1, std::int64_t{1} << 40);
    OGR_F_SetFieldDouble(full.get(), 2, 0.1);
    OGR_F_SetFieldString(full.get(), 3, "Straße 5");
    OGR_F_SetFieldString(full.get(), 4, "1890/05/17");
    OGR_F_SetFieldString(full.get(), 5, "12:34:56");
    OGR_F_SetFieldString(full.get(), 6, "2001/02/03 04:05:06+00");
    const std::array<GByte, 3> bytes{1, 0, 255};
    OGR_F_SetFieldBinary(full.get(), 7, 3, bytes.data());
    const std::array<int, 2> wholes{3, -4};
    OGR_F_SetFieldIntegerList(full.get(), 8, 2, wholes.data());
    const std::array<GIntBig, 1> large{GIntBig{1} << 50};
    OGR_F_SetFieldInteger64List(full.get(), 9, 1, large.data());
    const std::array<double, 2> reals{0.25, 1e300};
    OGR_F_SetFieldDoubleList(full.get(), 10, 2, reals.data());
    std::array<const char*, 3> texts{"a", "", nullptr};
    OGR_F_SetFieldStringList(full.get(), 11, texts.data());
    std::string wkt = "CURVEPOLYGON ZM (CIRCULARSTRING ZM (0 0 1 2,1 1 3 4,2 0 5 6,1 -1 7 8,0 0 1 2))";
    char* start = wkt.data();
    OGRGeometryH geometry = nullptr;
    ASSERT_EQ(OGR_G_CreateFromWkt(&start, nullptr, &geometry), OGRERR_NONE);
    OGR_F_SetGeometryDirectly(full.get(), geometry);
    OGR_F_SetStyleString(full.get(), "BRUSH(fc:#FF0000)");
    const std::vector<std::byte> encoded = original.encode(full.get(), OGR_F_GetGeometryRef(full.get()));
    EXPECT_EQ(text(original.decode(encoded).get()), text(full.get()));
}

TEST_F(OriginalLayers, tellNullFromUnset) {
    const OgrOriginalLayer original(layer_);
    const FeatureOwner bare = feature(0);
    OGR_F_SetFieldNull(bare.get(), 3);
    const FeatureOwner again = original.decode(original.encode(bare.get(), nullptr));
    EXPECT_EQ(text(again.get()), text(bare.get()));
    EXPECT_EQ(OGR_F_IsFieldSet(again.get(), 2), FALSE);
    EXPECT_NE(OGR_F_IsFieldNull(again.get(), 3), FALSE);
    EXPECT_EQ(OGR_F_GetGeometryRef(again.get()), nullptr);
}

TEST_F(OriginalLayers, outliveTheirDataset) {
    const OgrOriginalLayer original(layer_);
    const FeatureOwner bare = feature(3);
    const std::vector<std::byte> encoded = original.encode(bare.get(), nullptr);
    dataset_.reset();
    EXPECT_EQ(original.field_names().size(), types.size());
    EXPECT_EQ(original.field_names().front(), "Integer");
    EXPECT_EQ(original.geometry_type(), wkbCurvePolygon);
    EXPECT_EQ(OGR_F_GetFID(original.decode(encoded).get()), 3);
}

}  // namespace
}  // namespace d2b::reading
