#include "roofs/partition.hpp"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "roofs/made_roof.hpp"
#include "roofs/make_roof.hpp"

namespace d2b::roofs {
namespace {

constexpr std::int64_t steps = FinePoint::steps * roof_steps;

/// Lattice points as positions in cells.
std::vector<WorldPolygon> in_cells(const FinePolygon& polygon) {
    const auto ring = [](const FineRing& points) {
        WorldRing positions;
        for (const FinePoint& p : points)
            positions.push_back({static_cast<double>(p.col) / steps, -static_cast<double>(p.row) / steps});
        return positions;
    };
    WorldPolygon result{ring(polygon.exterior), {}};
    for (const FineRing& interior : polygon.interiors)
        result.interiors.push_back(ring(interior));
    return {result};
}

/// Edges of the footprint, and those that faces share.
void expect_tiles(const std::vector<LabelledFace>& faces, double area) {
    Geos geos;
    double sum = 0;
    for (const LabelledFace& face : faces) {
        EXPECT_EQ(geos.invalidity(in_cells(face.outline)), "");
        sum += area_in_cells(face.outline);
    }
    EXPECT_NEAR(sum, area, area * 1e-6);
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_FALSE(geos.overlap(in_cells(faces[i].outline), in_cells(faces[j].outline)));
}

class Partition : public testing::Test {
  protected:
    /// Labels of the whole grid by the rows and columns of the raster.
    [[nodiscard]] std::vector<LabelledFace> divide(
        const FinePolygon& footprint, const std::vector<BorderLine>& lines,
        const std::function<int(double row, double col)>& label) const {
        std::vector<std::int32_t> labels;
        for (std::int32_t row = 0; row < grid.rows; ++row)
            for (std::int32_t col = 0; col < grid.cols; ++col)
                labels.push_back(label(grid.first_row + row + 0.5, grid.first_col + col + 0.5));
        Geos geos;
        return partition(footprint, lines, labels, grid, lattice, geos);
    }
    [[nodiscard]] Vec2 at(double row, double col) const {
        return {grid.x(col - grid.first_col), grid.y(row - grid.first_row)};
    }

    MadeRoof roof{12, 20, [](double, double) { return 6.0; }};
    BuildingGrid grid = roof.grid();
    RoofLattice lattice{grid, 0.5};
};

TEST_F(Partition, WithoutLinesIsTheFootprint) {
    const auto faces = divide(roof.outline(roof_steps), {}, [](double, double) { return 0; });
    ASSERT_EQ(faces.size(), 1U);
    EXPECT_EQ(faces[0].outline.exterior, roof.outline(roof_steps).exterior);
    EXPECT_EQ(faces[0].label, 0);
    EXPECT_DOUBLE_EQ(area_in_cells(faces[0].outline), 240);
}

TEST_F(Partition, ALineAcrossMakesTwoFacesThatShareItsEnds) {
    const auto faces = divide(roof.outline(roof_steps), {{at(16.25, 17), at(16.25, 43)}},
                              [](double row, double) { return row < 16.25 ? 0 : 1; });
    ASSERT_EQ(faces.size(), 2U);
    expect_tiles(faces, 240);
    std::map<std::int32_t, double> areas;
    for (const LabelledFace& face : faces)
        areas[face.label] = area_in_cells(face.outline);
    EXPECT_NEAR(areas[0], 6.25 * 20, 1e-6);
    EXPECT_NEAR(areas[1], 5.75 * 20, 1e-6);
    int shared = 0;
    for (const FaceEdge& edge : face_edges(faces))
        if (edge.left >= 0 && edge.right >= 0) {
            ++shared;
            EXPECT_EQ(std::set<FinePoint>({edge.from, edge.to}),
                      std::set<FinePoint>({lattice.point(at(16.25, 20)), lattice.point(at(16.25, 40))}));
        }
    EXPECT_EQ(shared, 1);
}

TEST_F(Partition, ALineThatEndsInsideHasNoEffect) {
    const auto faces = divide(roof.outline(roof_steps), {{at(16.25, 17), at(16.25, 33)}},
                              [](double row, double) { return row < 16.25 ? 0 : 1; });
    ASSERT_EQ(faces.size(), 1U);
    expect_tiles(faces, 240);
}

TEST_F(Partition, FacesOfOneLabelAreOne) {
    const auto faces =
        divide(roof.outline(roof_steps), {{at(16.25, 17), at(16.25, 43)}, {at(7, 30.5), at(25, 30.5)}},
               [](double row, double) { return row < 16.25 ? 0 : 1; });
    EXPECT_EQ(faces.size(), 2U);
    expect_tiles(faces, 240);
}

TEST_F(Partition, CourtyardsStayOpen) {
    FinePolygon footprint = roof.outline(roof_steps);
    const auto corner = [](std::int64_t row, std::int64_t col) {
        return FinePoint{row * steps, col * steps};
    };
    footprint.interiors.push_back({corner(14, 28), corner(14, 33), corner(18, 33), corner(18, 28)});
    const auto faces = divide(footprint, {{at(16.25, 17), at(16.25, 43)}},
                              [](double row, double) { return row < 16.25 ? 0 : 1; });
    ASSERT_EQ(faces.size(), 2U);
    expect_tiles(faces, 220);
}

/// A face that lies in another one is a hole of it.
TEST_F(Partition, APenthouseIsAHoleOfTheRoofAroundIt) {
    const auto faces =
        divide(roof.outline(roof_steps),
               {{at(13, 25), at(13, 30)},
                {at(13, 30), at(18, 30)},
                {at(18, 30), at(18, 25)},
                {at(18, 25), at(13, 25)}},
               [](double row, double col) { return row > 13 && row < 18 && col > 25 && col < 30 ? 1 : 0; });
    ASSERT_EQ(faces.size(), 2U);
    expect_tiles(faces, 240);
    for (const LabelledFace& face : faces) {
        EXPECT_EQ(face.outline.interiors.size(), face.label == 0 ? 1U : 0U);
        EXPECT_NEAR(area_in_cells(face.outline), face.label == 0 ? 215 : 25, 1e-6);
    }
}

TEST_F(Partition, FacesOfLessThanACellJoinTheirNeighbour) {
    const auto faces = divide(roof.outline(roof_steps), {{at(10.02, 17), at(10.02, 43)}},
                              [](double row, double) { return row < 10.02 ? 0 : 1; });
    EXPECT_EQ(faces.size(), 1U);
    expect_tiles(faces, 240);
}

TEST_F(Partition, CellsOfAFaceAreThoseWithTheirCentresInIt) {
    const auto faces = divide(roof.outline(roof_steps), {{at(16.25, 17), at(16.25, 43)}},
                              [](double row, double) { return row < 16.25 ? 0 : 1; });
    std::set<std::size_t> all;
    for (const LabelledFace& face : faces) {
        const auto cells = cells_of(face.outline, grid, lattice);
        EXPECT_EQ(cells.size(), face.label == 0 ? 120U : 120U);
        all.insert(cells.begin(), cells.end());
    }
    EXPECT_EQ(all.size(), 240U);
}

}  // namespace
}  // namespace d2b::roofs
