#include <array>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/open_sinks.hpp"
#include "write/vector/dxf_sink.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {
namespace {

/// Entity of a drawing, as GDAL reads it.
struct Entity {
    std::string layer;
    std::string kind;  ///< of its geometry
    std::string text;
    std::vector<std::array<double, 3>> points;
};

class Drawing : public WriteTest {
  protected:
    [[nodiscard]] std::vector<Entity> entities(const std::string& name) const {
        const Dataset dataset = open_dataset(path(name));
        std::vector<Entity> all;
        OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), 0);
        while (OGRFeatureH feature = OGR_L_GetNextFeature(layer)) {
            OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
            Entity entity{OGR_F_GetFieldAsString(feature, OGR_F_GetFieldIndex(feature, "Layer")),
                          OGR_G_GetGeometryName(geometry),
                          OGR_F_GetFieldAsString(feature, OGR_F_GetFieldIndex(feature, "Text")),
                          {}};
            for (int i = 0; i < OGR_G_GetPointCount(geometry); ++i)
                entity.points.push_back(
                    {OGR_G_GetX(geometry, i), OGR_G_GetY(geometry, i), OGR_G_GetZ(geometry, i)});
            all.push_back(entity);
            OGR_F_Destroy(feature);
        }
        return all;
    }
    [[nodiscard]] static std::vector<LayerSpec> layers() {
        LayerSpec buildings = layer_spec("buildings");
        buildings.fields.push_back({"p90", "", FieldType::real, "m", ""});
        return {buildings, layer_spec("contours"), layer_spec("roofs")};
    }
    /// A building around a courtyard, on a ground at 40: its left arm is 30 wide, the other three 10.
    [[nodiscard]] static Feature block(double p50, double p90) {
        BuildingRecord record;
        record.ground = 40;
        record.heights_m = {p50, p50, p90, p90};
        Feature feature;
        feature.parts = {{{{0, 0}, {60, 0}, {60, 50}, {0, 50}}, {{{30, 10}, {30, 40}, {50, 40}, {50, 10}}}}};
        feature.z = 7;  // not that of the ground
        feature.record = record;
        return feature;
    }
    void draw(const WriteOptions& options, const std::vector<Feature>& buildings,
              const std::vector<Feature>& contours = {}, const std::vector<Feature>& roofs = {}) {
        const auto sink = open_sink(options, callbacks_);
        sink->begin(layers(), provenance());
        for (std::size_t i = 0; const auto* features : {&buildings, &contours, &roofs}) {
            for (const Feature& feature : *features)
                sink->add(i, feature);
            ++i;
        }
        sink->finish();
    }
    [[nodiscard]] std::string refusal(const WriteOptions& options) {
        return thrown<OptionError>([&] { static_cast<void>(open_sink(options, callbacks_)); });
    }
};

TEST_F(Drawing, hasClosedPolylinesAtTheirElevations) {
    Feature contour;
    contour.parts = {{{{1.25, 2}, {5, 2}, {5, 9.5}}, {}}, {{{11, 2}, {15, 2}, {15, 9}}, {}}};
    contour.z = 46.5;
    Feature face;
    face.parts = {{{{0, 0}, {4, 0}, {4, 4}}, {}, {}, {10, 10, 12.5}}};
    draw(to("a.dxf"), {block(12, 14)}, {contour}, {face});
    const std::vector<Entity> all = entities("a.dxf");
    ASSERT_EQ(all.size(), 6U);
    for (const std::size_t i : {0U, 1U, 3U, 4U, 5U}) {
        EXPECT_EQ(all[i].kind, "LINESTRING");
        EXPECT_EQ(all[i].points.front(), all[i].points.back());
    }
    using Points = std::vector<std::array<double, 3>>;
    EXPECT_EQ(all[0].layer, "buildings");
    EXPECT_EQ(all[0].points, (Points{{0, 0, 40}, {60, 0, 40}, {60, 50, 40}, {0, 50, 40}, {0, 0, 40}}));
    EXPECT_EQ(all[1].points, (Points{{30, 10, 40}, {30, 40, 40}, {50, 40, 40}, {50, 10, 40}, {30, 10, 40}}));
    EXPECT_EQ(all[3].layer, "contours");
    EXPECT_EQ(all[3].points, (Points{{1.25, 2, 46.5}, {5, 2, 46.5}, {5, 9.5, 46.5}, {1.25, 2, 46.5}}));
    EXPECT_EQ(all[4].points.front(), (std::array<double, 3>{11, 2, 46.5}));
    EXPECT_EQ(all[5].layer, "roofs");
    EXPECT_EQ(all[5].points, (Points{{0, 0, 10}, {4, 0, 10}, {4, 4, 12.5}, {0, 0, 10}}));
}

TEST_F(Drawing, hasHeightsAsTextsInsideTheirBuildings) {
    draw(to("a.dxf"),
         {block(12, 14), block(12.4, 25.2), block(2, 8), block(9.4, 9.44),
          block(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN())});
    std::vector<std::string> texts;
    for (const Entity& entity : entities("a.dxf")) {
        if (entity.kind != "POINT")
            continue;
        EXPECT_EQ(entity.layer, "heights");
        texts.push_back(entity.text);
        // Lies in the middle of the whole width, below or above the courtyard.
        EXPECT_EQ(entity.points[0][0], 30);
        EXPECT_TRUE(entity.points[0][1] < 10 || entity.points[0][1] > 40) << entity.points[0][1];
        EXPECT_EQ(entity.points[0][2], 40);
    }
    EXPECT_EQ(texts, (Names{"14", "12-25", "2.0-8.0", "9.4"}));
}

TEST_F(Drawing, isAFileOfAutocadsReleaseTwelve) {
    draw(to("a.dxf"), {});
    const std::string text = bytes("a.dxf");
    EXPECT_EQ(text.find("999\n"), 0U);
    EXPECT_NE(text.find("9\n$ACADVER\n1\nAC1009\n"), std::string::npos);
    for (const char* layer : {"buildings", "heights", "contours", "roofs"})
        EXPECT_NE(text.find("0\nLAYER\n2\n" + std::string(layer) + "\n"), std::string::npos) << layer;
    EXPECT_TRUE(text.ends_with("0\nENDSEC\n0\nEOF\n"));
    EXPECT_TRUE(entities("a.dxf").empty());
}

TEST_F(Drawing, namesItsLayersWithLettersThatItMayHave) {
    EXPECT_EQ(writing::drawing_layer_name("Dächer 2, $1-b_c"), "D__cher_2__$1-b_c");
    WriteOptions options = to("a.dxf");
    options.layer_name = "my roofs";
    const auto sink = open_sink(options, callbacks_);
    EXPECT_EQ(sink->layer_name(LayerRole::buildings, Layers::both), "my_roofs");
    EXPECT_EQ(sink->layer_name(LayerRole::contours, Layers::both), "my_roofs_contours");
    EXPECT_EQ(sink->layers({}), Layers::both);
}

TEST_F(Drawing, isThereWholeOrNotAtAll) {
    {
        const auto sink = open_sink(to("a.dxf"), callbacks_);
        sink->begin(layers(), provenance());
        sink->add(0, block(1, 2));
    }
    EXPECT_EQ(entries(), Names{});
    draw(to("a.dxf"), {block(1, 2)});
    EXPECT_EQ(refusal(to("a.dxf")), quote + path("a.dxf") + "\" exists; give -overwrite to replace it.");
    WriteOptions again = to("a.dxf");
    again.overwrite = true;
    draw(again, {block(1, 3), block(1, 4)});
    EXPECT_EQ(entities("a.dxf").size(), 6U);
    put("b.dxf", "Dear diary");
    again.destination = path("b.dxf");
    EXPECT_EQ(refusal(again),
              quote + path("b.dxf") + "\" exists and is not a DXF; choose another name, or remove it first.");
    EXPECT_EQ(bytes("b.dxf"), "Dear diary");
    // GDAL opens it, but it is somebody else's.
    const std::string plan =
        "  0\nSECTION\n  2\nENTITIES\n  0\nLINE\n  8\nPLAN\n 10\n1\n 20\n1\n 11\n2\n 21\n"
        "2\n  0\nENDSEC\n  0\nEOF\n";
    put("c.dxf", plan);
    again.destination = path("c.dxf");
    EXPECT_EQ(refusal(again), quote + path("c.dxf") +
                                  "\" is a drawing that dem2buildings has not written, and -overwrite would "
                                  "lose it; choose another name, or remove it first.");
    EXPECT_EQ(bytes("c.dxf"), plan);
}

TEST_F(Drawing, refusesOptionsWithoutAnEffect) {
    const auto expect = [&](const std::string& name, const WriteOptions& options) {
        EXPECT_EQ(refusal(options),
                  name +
                      " cannot be used with a DXF, a drawing without fields that is written whole; leave it "
                      "out, or write a GeoPackage.");
    };
    WriteOptions options = to("a.dxf");
    options.append = true;
    expect("-append", options);
    options = to("a.dxf");
    options.footprints = "osm.gpkg";
    expect("-footprints", options);
    options = to("a.dxf");
    options.fields = FieldNames::osm;
    expect("-fields", options);
    options = to("a.dxf");
    options.layer_options = {"A=B"};
    expect("-lco", options);
    options = to("a.dxf");
    options.dataset_options = {"A=B"};
    expect("-dsco", options);
    options = to("a.dxf");
    options.destination = "/vsistdout/";
    options.format = "DXF";
    EXPECT_EQ(refusal(options), "A DXF cannot be written to \"/vsistdout/\"; give a file.");
}

}  // namespace
}  // namespace d2b::test
