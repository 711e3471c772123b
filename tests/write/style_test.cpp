#include <algorithm>

#include "core/height_classes.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "write/qgis/qgis_style.hpp"
#include "write/write_fixture.hpp"

namespace d2b::writing {

namespace {

using namespace test;

class StyleTest : public WriteTest {
  protected:
    [[nodiscard]] WriteOptions over(const std::string& name) const {
        WriteOptions options = to(name);
        options.overwrite = true;
        return options;
    }
    [[nodiscard]] std::string ask(const std::string& statement) const {
        return sql(path("a.gpkg"), statement);
    }
    void change(const std::string& statement) const { sql(path("a.gpkg"), statement, true); }
    /// Names of the styles of a layer, the default one with a star.
    [[nodiscard]] std::string styles(const std::string& layer) const {
        return ask(
            "SELECT group_concat(n) FROM (SELECT styleName || CASE WHEN useAsDefault THEN '*' ELSE '' "
            "END AS n FROM layer_styles WHERE f_table_name = '" +
            layer + "' ORDER BY styleName)");
    }
};

TEST_F(StyleTest, AGeoPackageHasAStyleOfEachLayer) {
    write(to("a.gpkg"), 2);
    EXPECT_EQ(styles("buildings"), "dem2buildings*");
    EXPECT_EQ(styles("contours"), "dem2buildings*");
    EXPECT_EQ(ask("SELECT f_geometry_column FROM layer_styles"), "geom");
    EXPECT_EQ(ask("SELECT data_type FROM gpkg_contents WHERE table_name = 'layer_styles'"), "attributes");
    const std::string qml = ask("SELECT styleQML FROM layer_styles WHERE f_table_name = 'buildings'");
    EXPECT_NE(
        qml.find("filter=\"&quot;height&quot; &gt;= 3 AND &quot;height&quot; &lt; 6\" label=\"3 to 6 m\""),
        std::string::npos)
        << qml;
    EXPECT_NE(qml.find("label=\"Style of buildings\""), std::string::npos);  // heads the legend
    EXPECT_NE(qml.find("field=\"height\" index=\"1\" name=\"height [m]\""), std::string::npos);
    EXPECT_EQ(ask("PRAGMA integrity_check"), "ok");
    EXPECT_EQ(ask("PRAGMA foreign_key_check"), "");
}

/// A second style by suitability for panels, which the user chooses.
TEST_F(StyleTest, RoofsHaveTwoStyles) {
    LayerSpec spec = layer_spec("roofs");
    spec.fields.push_back({"slope", "", FieldType::real, "", ""});
    spec.fields.push_back({"azimuth", "", FieldType::real, "", ""});
    spec.style = {.title = "t", .label = "slope", .slope = "slope", .azimuth = "azimuth"};
    for (int run = 0; run < 2; ++run) {
        const auto sink = open_sink(over("a.gpkg"), callbacks_);
        sink->begin({&spec, 1}, provenance());
        sink->finish();
        EXPECT_EQ(styles("roofs"), "dem2buildings*,dem2buildings solar");
    }
    const std::string qml = ask("SELECT styleQML FROM layer_styles WHERE styleName = 'dem2buildings solar'");
    EXPECT_NE(qml.find("(&quot;slope&quot; BETWEEN 10 AND 60 AND &quot;azimuth&quot; BETWEEN 135 AND 225)"),
              std::string::npos)
        << qml;
}

/// Heights from 8 to 12 m lie in two of the fixed classes.
TEST_F(StyleTest, ManyFeaturesHaveAStyleByQuantiles) {
    LayerSpec spec = layer_spec("buildings");
    const auto sink = open_sink(to("a.gpkg"), callbacks_);
    sink->begin({&spec, 1}, provenance());
    for (int i = 0; i < 40; ++i)
        sink->add(0, {{std::int64_t{i + 1}, 8 + i * 0.1, std::string("ok")},
                      {{{{i * 10.0, 0}, {i * 10.0 + 5, 0}, {i * 10.0 + 5, 5}, {i * 10.0, 5}}, {}}},
                      0});
    sink->finish();
    EXPECT_EQ(styles("buildings"), "dem2buildings*,dem2buildings quantiles");
    const std::string qml =
        ask("SELECT styleQML FROM layer_styles WHERE styleName = 'dem2buildings quantiles'");
    for (const char* label :
         {"below 8.8 m", "8.8 to 9.6 m", "9.6 to 10.4 m", "10.4 to 11.2 m", "11.2 m and more"})
        EXPECT_NE(qml.find("label=\"" + std::string(label) + "\""), std::string::npos) << label;
    EXPECT_NE(qml.find("&gt;= 8.8 AND &quot;height&quot; &lt; 9.6"), std::string::npos);
}

TEST_F(StyleTest, AGeoPackageSaysWhatItsLayersAndFieldsAre) {
    write(to("a.gpkg"), 1);
    const std::string xml =
        ask("SELECT metadata FROM gpkg_metadata JOIN gpkg_metadata_reference ON id = md_file_id WHERE "
            "md_standard_uri = 'http://mrcc.com/qgis.dtd' AND table_name = 'contours'");
    EXPECT_NE(xml.find("<title>Title of contours</title>"), std::string::npos) << xml;
    EXPECT_NE(xml.find("height [m]: height above the ground"), std::string::npos);
    EXPECT_NE(xml.find("<history>thresholds: 1, 2</history>"), std::string::npos);
    EXPECT_EQ(ask("SELECT coalesce(title, name) || '|' || description FROM gpkg_data_columns WHERE "
                  "table_name = 'buildings' "
                  "AND column_name = 'height'"),
              "height [m]|height above the ground");
}

TEST_F(StyleTest, StylesOfOthersStay) {
    write(to("a.gpkg"), 1);
    change(
        "INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column, "
        "styleName, styleQML, useAsDefault, owner) VALUES ('', '', 'roads', 'geom', 'r', 'red', 1, 'me')");
    write(over("a.gpkg"), 2);
    EXPECT_EQ(styles("buildings"), "dem2buildings*");
    EXPECT_EQ(styles("roads"), "r*");
    EXPECT_EQ(ask("SELECT count(*) FROM layer_styles"), "3");
}

TEST_F(StyleTest, AUsersDefaultStaysTheDefault) {
    write(to("a.gpkg"), 1);
    change("UPDATE layer_styles SET useAsDefault = 0 WHERE f_table_name = 'buildings'");
    change(
        "INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column, "
        "styleName, styleQML, useAsDefault, owner) VALUES ('', '', 'buildings', 'geom', 'mine', 'q', 1, '')");
    write(over("a.gpkg"), 2);
    EXPECT_EQ(styles("buildings"), "dem2buildings,mine*");
    EXPECT_EQ(styles("contours"), "dem2buildings*");
}

TEST_F(StyleTest, AppendingChangesNoStyle) {
    write(to("a.gpkg"), 1);
    change("UPDATE layer_styles SET styleQML = 'touched'");
    WriteOptions options = to("a.gpkg");
    options.append = true;
    write(options, 1);
    EXPECT_EQ(ask("SELECT group_concat(styleQML) FROM layer_styles"), "touched,touched");
    EXPECT_EQ(ask("SELECT count(*) FROM gpkg_metadata WHERE md_standard_uri LIKE '%qgis%'"), "2");
}

TEST_F(StyleTest, OverwritingLeavesNoOldMetadata) {
    write(to("a.gpkg"), 1);
    const std::string before = ask("SELECT count(*) FROM gpkg_metadata");
    write(over("a.gpkg"), 1);
    EXPECT_EQ(ask("SELECT count(*) FROM gpkg_metadata"), before);
    EXPECT_EQ(ask("SELECT count(*) FROM gpkg_data_columns"), "6");
}

TEST_F(StyleTest, AShapefileHasItsStyleBeside) {
    write(to("a.shp"), 1);
    const Names names = entries();
    EXPECT_TRUE(std::ranges::find(names, "a.qml") != names.end());
    EXPECT_NE(bytes("a.qml").find(style_signature), std::string::npos);
    write(to("folder", "ESRI Shapefile"), 1);
    EXPECT_FALSE(bytes("folder/buildings.qml").empty());
    EXPECT_FALSE(bytes("folder/contours.qml").empty());
}

TEST_F(StyleTest, OurStyleOfAShapefileIsReplacedAndAUsersIsNot) {
    write(to("a.shp"), 1);
    const std::string ours = bytes("a.qml");
    put("a.qml", ours + " ");
    write(over("a.shp"), 1);
    EXPECT_EQ(bytes("a.qml"), ours);
    put("a.qml", "the user's");
    write(over("a.shp"), 1);
    EXPECT_EQ(bytes("a.qml"), "the user's");
    put("b.qml", "there before");
    write(to("b.shp"), 1);
    EXPECT_EQ(bytes("b.qml"), "there before");
    WriteOptions folder = to("folder", "ESRI Shapefile");
    write(folder, 1);
    put("folder/contours.qml", "the user's");
    folder.overwrite = true;
    write(folder, 1);
    EXPECT_EQ(bytes("folder/contours.qml"), "the user's");
    EXPECT_NE(bytes("folder/buildings.qml").find(style_signature), std::string::npos);
}

TEST_F(StyleTest, ColumnsOfTheLayerAreNamedNotThoseOfTheSpec) {
    LayerSpec spec = layer_spec("buildings");
    spec.fields[1].name = spec.style.colour = spec.style.label = "ROOF_HEIGHT";
    const auto sink = open_sink(to("a.shp"), callbacks_);
    sink->begin({&spec, 1}, provenance());
    sink->finish();
    EXPECT_NE(bytes("a.qml").find("&quot;ROOF_HEIGH&quot; &lt; 6"), std::string::npos);
}

TEST(Qml, SolidsStandFromBaseToTopInUnitsOfTheMap) {
    LayerSpec spec = layer_spec("contours");
    spec.fields.push_back({"top", "", FieldType::real, "ft", ""});
    spec.fields.push_back({"low", "", FieldType::real, "m", ""});
    spec.style = {.title = "t", .colour = "height"};
    EXPECT_EQ(qml_style(spec, {"id", "height", "status", "top", "low"}).find("renderer-3d"),
              std::string::npos);
    spec.style.top = "top";
    spec.style.height = "height";
    spec.style.min_height = "low";
    spec.style.vertical_scale = 0.25;
    spec.style.metre_scale = 2;
    const std::string qml = qml_style(spec, {"id", "height", "status", "top", "low"});
    EXPECT_NE(qml.find("\"(&quot;height&quot; - &quot;low&quot;) * 2\""), std::string::npos) << qml;
    EXPECT_NE(qml.find("\"&quot;top&quot; * 0.25 - (&quot;height&quot; - &quot;low&quot;) * 2\""),
              std::string::npos);
}

TEST(Qml, OnlyWhatIsLabelledIs) {
    LayerSpec spec = layer_spec("contours");
    spec.fields.push_back({"mean", "", FieldType::real, "m", ""});
    spec.fields.push_back({"tier", "", FieldType::real, "m", ""});
    const std::vector<std::string> columns{"id", "height", "status", "mean", "tier"};
    EXPECT_EQ(qml_style(spec, columns).find("THEN CASE"), std::string::npos);
    spec.style.labelled = {"mean", "tier"};
    EXPECT_NE(
        qml_style(spec, columns).find("fieldName=\"CASE WHEN &quot;mean&quot; = &quot;tier&quot; THEN CASE"),
        std::string::npos);
}

/// Where the median lies more than 5 m below the height, label and tooltip begin with it, and the legend says
/// so.
TEST(Qml, BlocksWithSeveralRoofsAreLabelledByARange) {
    for (const std::string median : {"p50", "d2b_p50"}) {
        LayerSpec spec = layer_spec("buildings");
        spec.fields.push_back({median, "", FieldType::real, "m", ""});
        spec.style = {.title = "t", .colour = "height", .label = "height", .height = "height"};
        const std::string qml = qml_style(spec, {"id", "height", "status", "median"});
        for (const char* part :
             {"fieldName=\"CASE WHEN &quot;height&quot; - &quot;median&quot; &gt; 5 THEN CASE WHEN "
              "&quot;median&quot; &lt; 10 THEN",
              "|| '&#8211;' ELSE '' END || CASE WHEN &quot;height&quot; &lt; 10 THEN",
              "<mapTip>[% CASE WHEN &quot;height&quot; - &quot;median&quot; &gt; 5 THEN "
              "round(&quot;median&quot;, 1) || '&#8211;' ELSE '' END %][% round(&quot;height&quot;, 1) %] "
              "m</mapTip>",
              "label=\"t; label 12\u201325 m: median to 90th percentile\""})
            EXPECT_NE(qml.find(part), std::string::npos) << part << '\n' << qml;
    }
    LayerSpec contours = layer_spec("contours");
    contours.style = {.title = "t", .colour = "height", .label = "height", .height = "height"};
    const std::string qml = qml_style(contours, {"id", "height", "status"});
    EXPECT_EQ(qml.find("&#8211;"), std::string::npos);
    EXPECT_NE(qml.find("label=\"t\""), std::string::npos);
}

TEST(Qml, LabelsMayBeOffered) {
    LayerSpec spec = layer_spec("contours");
    const std::vector<std::string> columns{"id", "height", "status"};
    spec.style.label = "height";
    EXPECT_NE(qml_style(spec, columns).find("labelsEnabled=\"1\""), std::string::npos);
    spec.style.labels_on = false;
    const std::string qml = qml_style(spec, columns);
    EXPECT_NE(qml.find("labelsEnabled=\"0\""), std::string::npos);
    EXPECT_NE(qml.find("<labeling"), std::string::npos);
}

TEST(Qml, WhatIsDoubtfulHasADashedOutlineInPrintWithoutColours) {
    LayerSpec spec = layer_spec("doubtful");
    spec.style = {.title = "t"};
    const std::string qml = qml_style(spec, {"id", "height", "status"});
    EXPECT_NE(qml.find("LinePatternFill"), std::string::npos);
    EXPECT_NE(qml.find("name=\"outline_style\" value=\"dash\""), std::string::npos);
    EXPECT_EQ(qml_style(layer_spec("buildings"), {"id", "height", "status"}).find("value=\"dash\""),
              std::string::npos);
}

TEST(Qml, ABlockStandsOnTheGround) {
    LayerSpec spec = layer_spec("buildings");
    spec.fields.push_back({"ground", "", FieldType::real, "ft", ""});
    spec.style = {.title = "t", .colour = "height", .bottom = "ground", .height = "height"};
    spec.style.vertical_scale = 0.25;
    const std::string qml = qml_style(spec, {"id", "height", "status", "ground"});
    EXPECT_NE(qml.find("value=\"&quot;ground&quot; * 0.25\""), std::string::npos) << qml;
    EXPECT_NE(qml.find("value=\"&quot;height&quot;\""), std::string::npos);
}

/// A direction has one colour: the sectors meet at odd multiples of 22.5 degrees, and north goes around 0.
TEST(Qml, FacesHaveTheColourOfTheirDirection) {
    LayerSpec spec = layer_spec("roofs");
    spec.fields.push_back({"slope", "", FieldType::real, "", ""});
    spec.fields.push_back({"azimuth", "", FieldType::real, "", ""});
    spec.style = {.title = "t", .label = "slope", .slope = "slope", .azimuth = "azimuth"};
    const std::string qml = qml_style(spec, {"id", "height", "status", "slope", "azimuth"});
    for (const char* rule :
         {"filter=\"&quot;azimuth&quot; &gt;= 337.5 OR &quot;azimuth&quot; &lt; 22.5\" label=\"north\"",
          "filter=\"&quot;azimuth&quot; &gt;= 157.5 AND &quot;azimuth&quot; &lt; 202.5\" label=\"south\"",
          "filter=\"&quot;azimuth&quot; IS NULL AND &quot;slope&quot; IS NOT NULL\" label=\"flat\"",
          "filter=\"&quot;slope&quot; IS NULL\" label=\"doubtful\"",
          "color_hsv((580 - &quot;azimuth&quot;) % 360, scale_linear(&quot;slope&quot;, 8, 50, 25, 75), 85)",
          "fieldName=\"round(&quot;slope&quot;) || '&#176;'\""})
        EXPECT_NE(qml.find(rule), std::string::npos) << rule << '\n' << qml;
    // The hue of the south is opposite to that of the north: 40 and 220.
    EXPECT_NE(qml.find("\"color\" value=\"217,173,87,255\""), std::string::npos);
    EXPECT_NE(qml.find("\"color\" value=\"87,130,217,255\""), std::string::npos);
}

TEST(Qml, WhatIsNotCertainIsPaler) {
    LayerSpec spec = layer_spec("buildings");
    EXPECT_EQ(qml_style(spec, {"id", "height", "status"}).find("paler"), std::string::npos);
    spec.fields.push_back({"sure", "", FieldType::real, "", ""});
    spec.style.certainty = "sure";
    spec.style.certain = 0.75;
    const std::string qml = qml_style(spec, {"id", "height", "status", "sure"});
    EXPECT_NE(
        qml.find("filter=\"&quot;sure&quot; &lt; 0.75 AND &quot;height&quot; IS NOT NULL\" label=\"paler: "
                 "less certain\""),
        std::string::npos)
        << qml;
    EXPECT_NE(qml.find("scale_linear(&quot;sure&quot;, 0.5, 0.75, "), std::string::npos);
}

TEST(Qml, ClassesMeetAndTheLastHasNoEnd) {
    EXPECT_EQ(class_label(0), "below 3 m");
    EXPECT_EQ(class_label(1), "3 to 6 m");
    EXPECT_EQ(class_label(height_classes().size() - 1), "100 m and more");
    EXPECT_TRUE(std::ranges::is_sorted(height_classes(), {}, &HeightClass::from));
}

TEST(HeightClasses, OfQuantilesHoldEqualNumbers) {
    EXPECT_TRUE(quantile_classes({1, 2, 3, 4, 5, 6, 7, 8, 9}).empty());  // too few
    EXPECT_TRUE(quantile_classes(std::vector<double>(50, 7.0)).empty());
    std::vector<double> heights;
    for (int i = 99; i >= 0; --i)
        heights.push_back(5 + i * 0.2);
    const std::vector<HeightClass> classes = quantile_classes(heights);
    ASSERT_EQ(classes.size(), 5U);
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const double to = i + 1 < classes.size() ? classes[i + 1].from : 1000;
        EXPECT_EQ(std::ranges::count_if(heights, [&](double h) { return h >= classes[i].from && h < to; }),
                  20);
        EXPECT_TRUE(i == 0 || classes[i].colour != classes[i - 1].colour);
    }
    // Nine tenths have the same height: bounds that coincide are one.
    std::vector<double> equal(90, 6.0);
    equal.insert(equal.end(), 10, 9.0);
    EXPECT_TRUE(quantile_classes(equal).empty());
}

TEST(Qml, MetadataHoldsWhatXmlWouldTakeForMarkup) {
    LayerSpec spec = layer_spec("a<b");
    const std::string xml = qgis_metadata(spec, {"", {{"D2B_SOURCE", "x & \"y\""}, {"D2B_MASK", ""}}});
    EXPECT_NE(xml.find("<title>Title of a&lt;b</title>"), std::string::npos);
    EXPECT_NE(xml.find("<history>source: x &amp; &quot;y&quot;</history>"), std::string::npos);
    EXPECT_EQ(xml.find("mask"), std::string::npos);
}

}  // namespace

}  // namespace d2b::writing
