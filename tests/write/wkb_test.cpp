#include "dem2buildings/wkb.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <cpl_conv.h>
#include <gtest/gtest.h>
#include <ogr_api.h>

#include "dem2buildings/error.hpp"

namespace {

std::string as_wkt(const d2b::Feature& feature, bool with_z, bool with_arcs = false) {
    d2b::MultiPolygonWkb wkb(with_z, with_arcs);
    const auto bytes = wkb.encode(feature);
    OGRGeometryH geometry = nullptr;
    EXPECT_EQ(OGR_G_CreateFromWkb(bytes.data(), nullptr, &geometry, static_cast<int>(bytes.size())),
              OGRERR_NONE);
    EXPECT_EQ(OGR_G_WkbSize(geometry), static_cast<int>(bytes.size()));
    char* text = nullptr;
    OGR_G_ExportToIsoWkt(geometry, &text);
    std::string wkt = text;
    CPLFree(text);
    OGR_G_DestroyGeometry(geometry);
    return wkt;
}

TEST(MultiPolygonWkb, APlaceIsAPoint) {
    d2b::Feature feature;
    feature.place = d2b::Position{1.5, -2};
    EXPECT_EQ(as_wkt(feature, false), "POINT (1.5 -2)");
}

d2b::Feature two_parts() {
    d2b::Feature feature;
    feature.parts = {{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{1, 1}, {1, 2}, {2, 2}}, {{5, 5}, {5, 6}, {6, 6}}}},
                     {{{20, 20}, {21, 20}, {20, 21}}, {}}};
    feature.z = 2.5;
    return feature;
}

TEST(MultiPolygonWkb, ClosesRingsAndKeepsTheirOrder) {
    EXPECT_EQ(
        as_wkt(two_parts(), false),
        "MULTIPOLYGON (((0 0,9 0,9 9,0 9,0 0),(1 1,1 2,2 2,1 1),(5 5,5 6,6 6,5 5)),((20 20,21 20,20 21,20 "
        "20)))");
}

TEST(MultiPolygonWkb, GivesEveryVertexTheHeight) {
    d2b::Feature feature = two_parts();
    feature.parts.erase(feature.parts.begin());
    EXPECT_EQ(as_wkt(feature, true), "MULTIPOLYGON Z (((20 20 2.5,21 20 2.5,20 21 2.5,20 20 2.5)))");
}

TEST(MultiPolygonWkb, ArcsAreCircularStrings) {
    d2b::Feature feature = two_parts();
    // A stadium: half circles left and right.
    feature.parts[0] = {{{4, 9}, {3, 6}, {4, 3}, {8, 3}, {9, 6}, {8, 9}}, {}, {{0, 0, 2}, {0, 3, 2}}};
    EXPECT_EQ(as_wkt(feature, false, true),
              "MULTISURFACE (CURVEPOLYGON (COMPOUNDCURVE (CIRCULARSTRING (4 9,3 6,4 3),(4 3,8 "
              "3),CIRCULARSTRING (8 3,9 "
              "6,8 9),(8 9,4 9))),((20 20,21 20,20 21,20 20)))");
    EXPECT_EQ(as_wkt(feature, false),
              "MULTIPOLYGON (((4 9,3 6,4 3,8 3,9 6,8 9,4 9)),((20 20,21 20,20 21,20 20)))");
}

TEST(MultiPolygonWkb, AnArcMayGoRoundTheEndOfItsRing) {
    d2b::Feature feature;
    feature.parts = {
        {{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{3, 2}, {2, 3}, {3, 4}, {4, 3}}}, {{1, 2, 2}, {1, 0, 2}}}};
    feature.z = 1;
    EXPECT_EQ(as_wkt(feature, true, true),
              "MULTISURFACE Z (CURVEPOLYGON Z ((0 0 1,9 0 1,9 9 1,0 9 1,0 0 1),COMPOUNDCURVE Z "
              "(CIRCULARSTRING Z (3 2 "
              "1,2 3 1,3 4 1),CIRCULARSTRING Z (3 4 1,4 3 1,3 2 1))))");
}

TEST(MultiPolygonWkb, BufferIsUsedAgain) {
    d2b::MultiPolygonWkb wkb(false);
    const std::size_t large = wkb.encode(two_parts()).size();
    d2b::Feature small = two_parts();
    small.parts.erase(small.parts.begin());
    // 9 bytes of a multipolygon, 9 of a polygon, 4 of a ring, 4 positions of 16.
    EXPECT_EQ(wkb.encode(small).size(), 9u + 9u + 4u + 4u * 16u);
    EXPECT_EQ(wkb.encode(two_parts()).size(), large);
}

TEST(MultiPolygonWkb, WhatIsForgottenIsMadeAnew) {
    d2b::Feature ring;
    ring.parts.emplace_back();
    for (int i = 0; i < (1 << 17); ++i)  // 2 MiB
        ring.parts.front().exterior.push_back({1.0 * i, 0.5 * i});
    d2b::MultiPolygonWkb wkb(false);
    const auto first = wkb.encode(ring);
    const std::vector<std::byte> kept(first.begin(), first.end());
    wkb.forget_large();
    EXPECT_LT(wkb.room(), first.size());
    const auto second = wkb.encode(ring);
    EXPECT_TRUE(std::ranges::equal(second, kept));
    wkb.forget_large();
    // 9 bytes of a multipolygon, twice 9 of a polygon, 4 rings of 4, 5 + 4 + 4 + 4 positions of 16.
    EXPECT_EQ(wkb.encode(two_parts()).size(), 9u + 2u * 9u + 4u * 4u + 17u * 16u);
}

TEST(MultiPolygonWkb, RefusesWhatIsNoPolygon) {
    d2b::MultiPolygonWkb wkb(false);
    d2b::Feature feature;
    try {
        static_cast<void>(wkb.encode(feature));
        FAIL();
    } catch (const d2b::OutputError& error) {
        EXPECT_STREQ(error.what(), "A feature without a polygon cannot be written.");
    }
    feature.parts = {{{{0, 0}, {1, 1}}, {}}};
    try {
        static_cast<void>(wkb.encode(feature));
        FAIL();
    } catch (const d2b::OutputError& error) {
        EXPECT_STREQ(error.what(),
                     "A polygon has a ring of fewer than three positions and cannot be written.");
    }
}

}  // namespace
