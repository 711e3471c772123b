#include "cli/option_effect.hpp"

namespace d2b::test {
TEST_F(OptionEffect, srcwin) {
    trace({"-srcwin", "15", "0", "15", "20"});
    const Layer stack = contours();
    EXPECT_EQ(stack.records[0].number("n_points"), 15 * 20);
    EXPECT_EQ(stack.records[0].box().MinX, 391015.5);
    EXPECT_EQ(stack.records[0].box().MaxX, 391029.5);
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(buildings().records[0].number("height"), 6);
    EXPECT_EQ(buildings().records[0].area(), 6);
}

TEST_F(OptionEffect, projwin) {
    trace({"-projwin", "391003", "5819997", "391010", "5819990"});
    // The points with 391003 <= x < 391010 and so in y: columns 3 to 9, rows 3 to 9.
    const Layer stack = contours();
    EXPECT_EQ(stack.records[0].number("n_points"), 7 * 7);
    EXPECT_EQ(stack.records[0].box().MinX, 391003.5);
    EXPECT_EQ(stack.records[0].box().MaxY, 5819996.5);
    EXPECT_EQ(stack.records[0].number("elev_min"), 10);
}

TEST_F(OptionEffect, te) {
    trace({"-te", "391015", "5819990", "391030", "5820000"});
    const Layer stack = contours();
    EXPECT_EQ(stack.records[0].number("n_points"), 15 * 10);
    EXPECT_EQ(stack.records[0].box().MinX, 391015.5);
    EXPECT_EQ(stack.records[0].box().MinY, 5819990.5);
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(buildings().records[0].number("height"), 6);
}

TEST_F(OptionEffect, cutline) {
    write_text(path("area.geojson"),
               R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:25833"}},
                   "features": [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
                   [[[391015, 5820000], [391030, 5820000], [391030, 5819980], [391015, 5820000]]]}}]})");
    trace({"-cutline", "area.geojson", "-trace", "cells"});
    // Those cells count whose centres are in the triangle: to the right of x = 15 + 0.75 y, y downwards.
    int inside = 0;
    for (int row = 0; row < 20; ++row)
        for (int col = 15; col < 30; ++col)
            inside += col + 0.5 > 15 + 0.75 * (row + 0.5) ? 1 : 0;
    EXPECT_EQ(contours().sum("n_points", 0), inside);
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(buildings().records[0].area(), 3 + 2 + 1);  // what is inside of rows 5, 6 and 7
}

/// Two rectangles of cells, one a layer of areas.vrt: rows 5 to 7 of a building, and what is to the left of
/// it.
TEST_F(OptionEffect, cutline_layer) {
    const auto file = [this](const std::string& name, int left, int right) {
        const auto x = [](int col) { return std::to_string(391000 + col); };
        write_text(path(name + ".csv"), "id,WKT\n1,\"POLYGON ((" + x(left) + " 5820000," + x(right) +
                                            " 5820000," + x(right) + " 5819980," + x(left) + " 5819980," +
                                            x(left) + " 5820000))\"\n");
        return "<OGRVRTLayer name=\"" + name + "\"><SrcDataSource relativeToVRT=\"1\">" + name +
               ".csv</SrcDataSource><SrcLayer>" + name +
               "</SrcLayer><LayerSRS>EPSG:25833</LayerSRS>"
               "</OGRVRTLayer>";
    };
    write_text(path("areas.vrt"),
               "<OGRVRTDataSource>" + file("west", 0, 15) + file("east", 15, 30) + "</OGRVRTDataSource>");
    trace({"-cutline", "areas.vrt", "-cutline_layer", "east", "-trace", "cells"});
    EXPECT_EQ(contours().sum("n_points", 0), 15 * 20);
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(buildings().records[0].area(), 3 * 4);
    run_warned({"-q", "-overwrite", "-fl", "5", "-cutline", "areas.vrt", "blocks.tif", "out.gpkg"},
               {"has the layers 'west' and 'east'; 'west' is taken, and -cutline_layer takes another."});
    EXPECT_EQ(buildings().records.size(), 1U);
}

}  // namespace d2b::test
