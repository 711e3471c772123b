#include "roofs/meeting_planes.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "roofs/made_roof.hpp"
#include "roofs/make_roof.hpp"

namespace d2b::roofs {
namespace {

/// Two faces with the border at row 16 of a rectangle of 12 x 20 cells.
struct TwoFaces {
    explicit TwoFaces(Height height) : roof{12, 20, std::move(height)} {
        const auto at = [](std::int64_t row, std::int64_t col) {
            return FinePoint{row * FinePoint::steps * roof_steps, col * FinePoint::steps * roof_steps};
        };
        faces = {{{{at(10, 20), at(16, 20), at(16, 40), at(10, 40)}, {}}, 0},
                 {{{at(16, 20), at(22, 20), at(22, 40), at(16, 40)}, {}}, 1}};
        for (const LabelledFace& face : faces)
            cells.push_back(cells_of(face.outline, grid, lattice));
    }
    void solve(const std::vector<Plane>& first) {
        planes = meeting_planes(faces, face_edges(faces), first, cells, grid, lattice);
        elevations = corner_elevations(faces, planes, lattice);
    }
    /// Elevation of the corner of a face at a row and column of the raster.
    [[nodiscard]] double corner(std::size_t face, std::int64_t row, std::int64_t col) const {
        for (std::size_t i = 0; i < faces[face].outline.exterior.size(); ++i)
            if (const FinePoint& p = faces[face].outline.exterior[i];
                p.row == row * FinePoint::steps * roof_steps && p.col == col * FinePoint::steps * roof_steps)
                return elevations[face][i] + grid.datum;
        ADD_FAILURE() << "no corner at " << row << ' ' << col;
        return 0;
    }

    MadeRoof roof;
    BuildingGrid grid = roof.grid();
    RoofLattice lattice{grid, 0.5};
    std::vector<LabelledFace> faces;
    std::vector<std::vector<std::size_t>> cells;
    std::vector<FacePlane> planes;
    std::vector<std::vector<double>> elevations;
};

/// Noise moves each plane by itself, but both have one elevation at the ridge.
TEST(MeetingPlanes, MeetAlongTheRidge) {
    std::mt19937 random(4);
    TwoFaces two([&](double row, double col) {
        return gable(16, 0.7)(row, col) + 0.2 * (static_cast<double>(random() % 1000) / 1000 - 0.5);
    });
    two.solve({plane_of(two.grid, 16, 0, 9.05, 0.69, 0.002), plane_of(two.grid, 16, 0, 8.95, -0.71, -0.003)});
    for (const int col : {20, 40}) {
        EXPECT_NEAR(two.corner(0, 16, col), two.corner(1, 16, col), 1e-3);
        EXPECT_NEAR(two.corner(0, 16, col), 9, 0.1);
    }
    EXPECT_NEAR(two.planes[0].plane.slope_y, 0.7, 0.03);
    EXPECT_NEAR(two.planes[1].plane.slope_y, -0.7, 0.03);
    // All corners of a face are on its plane.
    for (std::size_t face = 0; face < 2; ++face)
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec2 at = two.lattice.position(two.faces[face].outline.exterior[i]);
            EXPECT_NEAR(two.elevations[face][i], two.planes[face].plane.at(at.x, at.y), 1e-3);
        }
}

/// Three corners that are not in a line can only be shared by equal planes. The one off the ridge is given
/// up.
TEST(MeetingPlanes, KeepTheirSlopesWhereACornerIsOffTheRidge) {
    TwoFaces two(gable(16, 0.7));
    const std::int64_t steps = FinePoint::steps * roof_steps;
    const FinePoint off_ridge{16 * steps - steps / 32, 30 * steps};
    two.faces[0].outline.exterior.insert(two.faces[0].outline.exterior.begin() + 2, off_ridge);
    two.faces[1].outline.exterior.push_back(off_ridge);
    two.solve({plane_of(two.grid, 16, 0, 9, 0.7, 0), plane_of(two.grid, 16, 0, 9, -0.7, 0)});
    EXPECT_NEAR(two.planes[0].plane.slope_y, 0.7, 0.03);
    EXPECT_NEAR(two.planes[1].plane.slope_y, -0.7, 0.03);
    for (const int col : {20, 40})
        EXPECT_NEAR(two.corner(0, 16, col), two.corner(1, 16, col), 1e-3);
}

TEST(MeetingPlanes, AStepStays) {
    TwoFaces two([](double row, double) { return row < 16 ? 6.0 : 9.0; });
    two.solve({plane_of(two.grid, 0, 0, 6, 0, 0), plane_of(two.grid, 0, 0, 9, 0, 0)});
    for (const int col : {20, 40}) {
        EXPECT_NEAR(two.corner(0, 16, col), 6, 0.01);
        EXPECT_NEAR(two.corner(1, 16, col), 9, 0.01);
    }
    EXPECT_FALSE(two.planes[0].level);
}

/// A face of 70 degrees is a wall or a tree.
TEST(MeetingPlanes, TooSteepFacesAreLevel) {
    const double steep = std::tan(70 * 3.14159265358979 / 180);
    TwoFaces two([&](double row, double) { return row < 16 ? 6.0 : 9.0 + steep * (row - 16); });
    two.solve({plane_of(two.grid, 0, 0, 6, 0, 0), plane_of(two.grid, 16, 0, 9, steep, 0)});
    EXPECT_FALSE(two.planes[0].level);
    EXPECT_TRUE(two.planes[1].level);
    EXPECT_EQ(two.planes[1].plane.slope_y, 0);
    EXPECT_NEAR(two.corner(1, 16, 20), two.corner(1, 22, 40), 1e-9);
}

/// A border of 20 cells at a price of 2 m2 has to save 40 m2. A step of 10 cm between 240 cells saves
/// 240 * 0.05^2 = 0.6 m2, and one of 3 m is no low step.
TEST(MergedFaces, AreThoseWithALowStepThatSavesLittle) {
    for (const auto& [rise, expected] :
         {std::pair{0.1, std::vector<std::int32_t>{0, 0}}, std::pair{3.0, std::vector<std::int32_t>{0, 1}}}) {
        const double step = rise;  // a lambda of clang 14 cannot capture a structured binding
        TwoFaces two([&](double row, double) { return row < 16 ? 6.0 : 6.0 + step; });
        two.planes = {{plane_of(two.grid, 0, 0, 6, 0, 0)}, {plane_of(two.grid, 0, 0, 6 + step, 0, 0)}};
        EXPECT_EQ(merged_faces(face_edges(two.faces), two.planes, two.cells, 2, two.grid, two.lattice),
                  expected)
            << step;
    }
}

/// Joining the two would add no more than the price: 0.15^2 * 12^3 / 48 = 0.8 m2 per cell of the ridge.
TEST(MergedFaces, ARidgeIsNotALowStep) {
    TwoFaces two(gable(16, 0.15));
    two.planes = {{plane_of(two.grid, 16, 0, 9, 0.15, 0)}, {plane_of(two.grid, 16, 0, 9.05, -0.15, 0)}};
    EXPECT_EQ(merged_faces(face_edges(two.faces), two.planes, two.cells, 2, two.grid, two.lattice),
              (std::vector<std::int32_t>{0, 1}));
}

}  // namespace
}  // namespace d2b::roofs
