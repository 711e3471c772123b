// Planes of roofs: values by hand, the heights of the generator, and the raster of the town.
#include "roof_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "draft.hpp"
#include "place.hpp"
#include "sample_files.hpp"

namespace d2b::test {
namespace {

using namespace sample;

/// A building on level ground of 100 m.
Building built(const Draft& draft, const Frame& frame = {}) {
    Scene scene;
    scene.ground.base = 100;
    scene.ground.relief = 0;
    return scene.add(draft, frame);
}

double area_of(const std::vector<RoofCorner>& ring) {
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& p = ring[i].at;
        const Position& q = ring[(i + 1) % ring.size()].at;
        twice += p.x * q.y - q.x * p.y;
    }
    return twice / 2;
}

/// Area of a ring; that of holes is negative.
double area_of(const RoofFace& face) {
    double area = 0;
    for (const std::vector<RoofCorner>& ring : face.rings)
        area += area_of(ring);
    return area;
}

/// Number of faces with an area, a slope and an azimuth (-1 for none), all in thousandths.
using Faces = std::map<std::array<long, 3>, int>;

std::array<long, 3> figures(double area, double slope, double azimuth) {
    return {std::lround(1000 * area), std::lround(1000 * slope), std::lround(1000 * azimuth)};
}

Faces faces_of(const Building& building) {
    Faces faces;
    for (const RoofFace& face : roof_faces(building))
        ++faces[figures(area_of(face), face.slope, face.azimuth.value_or(-1))];
    return faces;
}

double degrees(double tangent) {
    return std::atan(tangent) * 180 / std::numbers::pi;
}

TEST(RoofFaces, OfAGable) {
    const Building house = built(box_house("house", {0, 0, 12, 8}, {Roof::gabled, 3, 1}));
    EXPECT_EQ(faces_of(house), (Faces{{figures(48, 45, 180), 1}, {figures(48, 45, 0), 1}}));
    const RoofFace south = roof_faces(house).front();
    ASSERT_EQ(south.rings.size(), 1U);
    ASSERT_EQ(south.rings[0].size(), 4U);
    for (const RoofCorner& corner : south.rings[0])
        EXPECT_DOUBLE_EQ(corner.elevation, house.ground + 3 + corner.at.y);
    EXPECT_EQ(roof_type(house), "gabled");
}

TEST(RoofFaces, TurnWithTheirBuilding) {
    // The x axis points to (4, 3) / 5: the ridge runs 36.87 degrees north of east.
    const Building house =
        built(box_house("house", {0, 0, 12, 8}, {Roof::gabled, 3, 1}), {{50, 60}, {0.8, 0.6}});
    const double turn = degrees(0.75);
    EXPECT_EQ(faces_of(house), (Faces{{figures(48, 45, 180 - turn), 1}, {figures(48, 45, 360 - turn), 1}}));
}

TEST(RoofFaces, OfAShed) {
    const Building steep = built(box_house("house", {0, 0, 12, 8}, {Roof::shed, 3, 0.25}));
    EXPECT_EQ(faces_of(steep), (Faces{{figures(96, degrees(0.25), 180), 1}}));
    // Water on nearly level roofs has no direction.
    const Building level = built(box_house("house", {0, 0, 12, 8}, {Roof::shed, 3, 0.14}));
    EXPECT_EQ(faces_of(level), (Faces{{figures(96, degrees(0.14), -1), 1}}));
}

TEST(RoofFaces, OfHips) {
    // The ridge is 4 m long: trapezoids of (12 + 4) / 2 x 4 m and triangles of 8 x 4 / 2 m.
    const Building house = built(box_house("house", {0, 0, 12, 8}, {Roof::hipped, 3, 0.5}));
    const double slope = degrees(0.5);
    EXPECT_EQ(faces_of(house), (Faces{{figures(32, slope, 180), 1},
                                      {figures(32, slope, 0), 1},
                                      {figures(16, slope, 270), 1},
                                      {figures(16, slope, 90), 1}}));
    EXPECT_EQ(roof_type(house), "hipped");
    const Building square = built(box_house("house", {0, 0, 8, 8}, {Roof::hipped, 3, 0.5}));
    for (const auto& [face, count] : faces_of(square))
        EXPECT_EQ(face, figures(16, slope, static_cast<double>(face[2]) / 1000));
    EXPECT_EQ(roof_type(square), "pyramidal");
}

TEST(RoofFaces, OfAMansard) {
    // 1.5 m from the wall the roof has 3.5 of its 5 m; the upper part of 17 x 7 m has a ridge of 10 m.
    const Building house = built(box_house("house", {0, 0, 20, 10}, {Roof::mansard, 3, 1}));
    const double steep = degrees(3.5 / 1.5);
    const double gentle = degrees(1.5 / 3.5);
    EXPECT_EQ(faces_of(house), (Faces{{figures(27.75, steep, 180), 1},
                                      {figures(27.75, steep, 0), 1},
                                      {figures(12.75, steep, 270), 1},
                                      {figures(12.75, steep, 90), 1},
                                      {figures(47.25, gentle, 180), 1},
                                      {figures(47.25, gentle, 0), 1},
                                      {figures(12.25, gentle, 270), 1},
                                      {figures(12.25, gentle, 90), 1}}));
    EXPECT_EQ(roof_type(house), "mansard");
}

TEST(RoofFaces, OfCrossingWings) {
    // Ridges of one height cross at (3, 3), where the pieces of each plane touch in a point. A piece at the
    // crossing is 4.5 m2, and its like at the free end of the wing has another 6 x 3 or 4 x 3 m.
    const Building house = built(l_house("house", {0, 0, 12, 10}, 6, {Roof::gabled, 3, 1}));
    Faces expected;
    for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
        expected[figures(4.5, 45, azimuth)] = 1;
        expected[figures(azimuth == 90 || azimuth == 270 ? 16.5 : 22.5, 45, azimuth)] = 1;
    }
    EXPECT_EQ(faces_of(house), expected);
    EXPECT_EQ(roof_type(house), "gabled");
}

TEST(RoofFaces, OfLevelWingsAreOneAndStoreysCutThem) {
    Draft draft = l_house("house", {0, 0, 12, 10}, 6, {Roof::flat, 9, 0});
    draft.parts.push_back({{1, 1, 5, 5}, Roof::flat, 12, 12, true});
    const Building house = built(draft);
    EXPECT_EQ(faces_of(house), (Faces{{figures(96 - 16, 0, -1), 1}, {figures(16, 0, -1), 1}}));
    EXPECT_EQ(roof_faces(house).front().rings.size(), 2U);
    EXPECT_EQ(roof_type(house), "flat");
}

TEST(RoofFaces, OfRoundBuildings) {
    const Building drum = built(round_house("drum", {0, 0}, 10, {Roof::flat, 9, 0}, 0));
    ASSERT_EQ(roof_faces(drum).size(), 1U);
    EXPECT_EQ(roof_faces(drum).front().rings[0].size(), 64U);
    for (const Roof roof : {Roof::cone, Roof::dome}) {
        const Building round = built(round_house("tank", {0, 0}, 10, {roof, 9, 0}, 3));
        EXPECT_TRUE(roof_faces(round).empty());
        EXPECT_EQ(roof_type(round), "domed");
    }
}

/// The elevation of a face's plane through three of its corners.
double elevation_at(const std::vector<RoofCorner>& ring, const Position& p) {
    // Two corners far apart, and the one farthest from the line between them.
    const RoofCorner& a = ring.front();
    const auto& b = *std::max_element(ring.begin(), ring.end(), [&](const auto& c, const auto& d) {
        return distance(a.at, c.at) < distance(a.at, d.at);
    });
    const auto& e = *std::max_element(ring.begin(), ring.end(), [&](const auto& c, const auto& d) {
        return std::abs(left_of(a.at, b.at, c.at)) < std::abs(left_of(a.at, b.at, d.at));
    });
    const double v = left_of(a.at, b.at, p) / left_of(a.at, b.at, e.at);
    const double length = distance(a.at, b.at);
    const auto along = [&](const Position& q) {
        return ((q.x - a.at.x) * (b.at.x - a.at.x) + (q.y - a.at.y) * (b.at.y - a.at.y)) / (length * length);
    };
    const double u = along(p) - v * along(e.at);
    return a.elevation + u * (b.elevation - a.elevation) + v * (e.elevation - a.elevation);
}

WorldPolygon outline_of(const RoofFace& face) {
    WorldPolygon polygon;
    for (std::size_t i = 0; i < face.rings.size(); ++i) {
        WorldRing& ring = i == 0 ? polygon.exterior : polygon.interiors.emplace_back();
        for (const RoofCorner& corner : face.rings[i])
            ring.push_back(corner.at);
    }
    return polygon;
}

double area_of(const WorldPolygon& polygon) {
    RoofFace face;
    face.rings.resize(1);
    for (const Position& p : polygon.exterior)
        face.rings[0].push_back({p, 0});
    for (const WorldRing& hole : polygon.interiors) {
        face.rings.emplace_back();
        for (const Position& p : hole)
            face.rings.back().push_back({p, 0});
    }
    return area_of(face);
}

/// One face lies over each point of the building, at the building's elevation.
void expect_one_face_at(const Position& p, const Building& building, const std::vector<RoofFace>& faces) {
    int found = 0;
    for (const RoofFace& face : faces) {
        if (!contains(outline_of(face), p))
            continue;
        ++found;
        ASSERT_NEAR(elevation_at(face.rings[0], p), building.elevation_at(p).value_or(0), 1e-6)
            << building.kind << " at " << p.x << ", " << p.y;
    }
    ASSERT_EQ(found, contains(building.footprint, p) ? 1 : 0) << building.kind;
}

TEST(RoofFaces, OfAllPlacesAreWhatTheirBuildingsAreMadeOf) {
    for (const Place& place : places()) {
        SCOPED_TRACE(place.name);
        const Scene scene = place.make(3);
        for (const Building& building : scene.buildings) {
            const std::vector<RoofFace> faces = roof_faces(building);
            double area = 0;
            for (const RoofFace& face : faces) {
                area += area_of(face);
                for (const std::vector<RoofCorner>& ring : face.rings)
                    for (const RoofCorner& corner : ring)
                        EXPECT_NEAR(corner.elevation, elevation_at(face.rings[0], corner.at), 1e-6);
            }
            ASSERT_EQ(faces.empty(), roof_type(building) == "domed");
            if (faces.empty())
                continue;
            EXPECT_NEAR(area, area_of(building.footprint), 1e-5) << building.kind;
            const Rect box = bounds(building.footprint.exterior);
            for (double y = box.y0 + 0.31; y < box.y1; y += 1.7)
                for (double x = box.x0 + 0.17; x < box.x1; x += 1.3)
                    expect_one_face_at({x, y}, building, faces);
        }
    }
}

TEST(RoofFaces, OfTheEstateHaveAllForms) {
    std::map<std::string, int> types;
    for (const Building& building : estate(1).buildings)
        ++types[std::string(roof_type(building))];
    EXPECT_EQ(types, (std::map<std::string, int>{{"domed", 10},
                                                 {"flat", 10},
                                                 {"gabled", 20},
                                                 {"hipped", 10},
                                                 {"mansard", 20},
                                                 {"pyramidal", 20},
                                                 {"shed", 10}}));
}

/// A face of the committed file.
struct TownFace {
    std::int64_t building = 0;
    std::string type;
    double slope = 0;
    std::optional<double> azimuth;
    std::unique_ptr<OGRPolygon> polygon;
};

std::vector<TownFace> town_faces() {
    GDALAllRegister();
    const Dataset dataset(GDALDataset::Open((std::string(D2B_SAMPLES) + "/town_roofs.gpkg").c_str()));
    EXPECT_EQ(dataset->GetLayerCount(), 1);
    OGRLayer& layer = *dataset->GetLayerByName("roofs");
    EXPECT_EQ(layer.GetGeomType(), wkbPolygon25D);
    std::vector<TownFace> faces;
    for (const auto& feature : layer) {
        TownFace& face = faces.emplace_back();
        face.building = feature->GetFieldAsInteger64("bldg_id");
        face.type = feature->GetFieldAsString("roof_type");
        face.slope = feature->GetFieldAsDouble("slope");
        if (feature->IsFieldSetAndNotNull(feature->GetFieldIndex("azimuth")))
            face.azimuth = feature->GetFieldAsDouble("azimuth");
        face.polygon.reset(feature->GetGeometryRef()->toPolygon()->clone());
    }
    return faces;
}

TEST(TownRoofs, CoverTheFootprintsOfAllButCurvedRoofs) {
    std::map<std::int64_t, double> covered;
    std::map<std::int64_t, std::string> types;
    for (const TownFace& face : town_faces()) {
        covered[face.building] += face.polygon->get_Area();
        types[face.building] = face.type;
        EXPECT_TRUE(face.polygon->IsValid());
        EXPECT_FALSE(face.polygon->getExteriorRing()->isClockwise());
    }
    std::int64_t id = 0;
    std::size_t curved = 0;
    for (const Footprint& house : truth_of("town").footprints) {
        ++id;
        if (house.roof == "cone" || house.roof == "dome") {
            ++curved;
            EXPECT_FALSE(covered.contains(id));
            continue;
        }
        EXPECT_NEAR(covered[id], house.area, 1e-5) << house.fields;
        if (types[id] != "pyramidal")
            EXPECT_EQ(types[id], house.roof);
        else
            EXPECT_LE(std::abs(house.width_m - house.length_m), 1) << house.fields;
    }
    EXPECT_EQ(covered.size() + curved, truth_of("town").footprints.size());
}

TEST(TownRoofs, ArePlanesOfTheRaster) {
    const Raster raster = read_raster(D2B_SAMPLES, "town");
    int cells = 0;
    int above = 0;
    for (const TownFace& face : town_faces()) {
        const OGRLinearRing& line = *face.polygon->getExteriorRing();
        std::vector<RoofCorner> ring;
        for (int i = 0; i + 1 < line.getNumPoints(); ++i)
            ring.push_back({{line.getX(i), line.getY(i)}, line.getZ(i)});
        for (const RoofCorner& corner : ring)
            EXPECT_NEAR(corner.elevation, elevation_at(ring, corner.at), 1e-3);
        const Position middle = ring.front().at;
        const double z = elevation_at(ring, middle);
        const double east = elevation_at(ring, {middle.x + 1, middle.y}) - z;
        const double north = elevation_at(ring, {middle.x, middle.y + 1}) - z;
        EXPECT_NEAR(face.slope, degrees(std::hypot(east, north)), 1e-4);
        ASSERT_EQ(face.azimuth.has_value(), face.slope >= 8);
        if (face.azimuth) {
            const double turn = *face.azimuth * std::numbers::pi / 180;
            const double fall = std::tan(face.slope * std::numbers::pi / 180);
            EXPECT_NEAR(east, -fall * std::sin(turn), 1e-5);
            EXPECT_NEAR(north, -fall * std::cos(turn), 1e-5);
        }
        OGREnvelope box;
        face.polygon->getEnvelope(&box);
        for (int row = static_cast<int>(raster.transform[3] - box.MaxY);
             row <= raster.transform[3] - box.MinY; ++row)
            for (int col = static_cast<int>(box.MinX - raster.transform[0]);
                 col <= box.MaxX - raster.transform[0]; ++col) {
                const OGRPoint centre = raster.centre(row, col);
                if (!face.polygon->Contains(&centre))
                    continue;
                ++cells;
                // 3.5 standard deviations of the noise, and rounding.
                const double error = static_cast<double>(raster.at(row, col)) -
                                     elevation_at(ring, {centre.getX(), centre.getY()});
                EXPECT_GT(error, -0.16);
                above += error > 0.16 ? 1 : 0;
            }
    }
    EXPECT_GT(cells, 100000);
    EXPECT_LT(above, cells / 50);  // crowns
}

}  // namespace
}  // namespace d2b::test
