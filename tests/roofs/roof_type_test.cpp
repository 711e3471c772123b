#include "roofs/roof_type.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace d2b::roofs {
namespace {

struct TypeCase {
    std::string type;
    std::vector<FaceShape> faces;
    double roundness = 0.75;  ///< a rectangle of 12 x 17
};

class RoofType : public testing::TestWithParam<TypeCase> {};

TEST_P(RoofType, IsThatOfItsFaces) {
    std::vector<FaceShape> faces = GetParam().faces;
    EXPECT_EQ(roof_type(faces, GetParam().roundness, 0.5), GetParam().type);
    // Whatever the direction of the building, and of its rows.
    for (const double turn : {17.0, 90.0, 201.5}) {
        std::vector<FaceShape> turned = faces;
        for (FaceShape& face : turned)
            face.azimuth += turn;
        EXPECT_EQ(roof_type(turned, GetParam().roundness, 0.5), GetParam().type) << turn;
    }
    for (FaceShape& face : faces)
        face.azimuth = -face.azimuth;
    EXPECT_EQ(roof_type(faces, GetParam().roundness, 0.5), GetParam().type);
}

// A face has area, slope, azimuth, taper, whether it is doubtful, its lowest and highest elevations, and the
// length of its upper end.
INSTANTIATE_TEST_SUITE_P(
    Table, RoofType,
    testing::Values(
        TypeCase{"unknown", {{60, 0, 0, 1, true}, {40, 30, 0}}}, TypeCase{"flat", {{100, 2, 0}}},
        TypeCase{"flat", {{80, 0, 0}, {20, 30, 90}}}, TypeCase{"flat", {{50, 0, 0}, {50, 3, 140}}},
        TypeCase{"flat", {{60, 0, 0}, {40, 40, 0, 1, true}}}, TypeCase{"shed", {{100, 20, 90}}},
        TypeCase{"shed", {{80, 20, 90}, {20, 1, 0}}}, TypeCase{"gabled", {{50, 35, 0}, {50, 35, 180}}},
        TypeCase{"gabled", {{60, 35, 10}, {40, 40, 195}}},
        TypeCase{"gabled", {{48, 35, 0}, {48, 35, 180}, {4, 0, 0}}},
        // A wing with a gable of its own: no side ends in a point.
        TypeCase{"gabled", {{36, 35, 0}, {36, 35, 180}, {14, 35, 90}, {14, 35, 270}}},
        TypeCase{"hipped", {{36, 35, 0, 0.6}, {36, 35, 180, 0.6}, {14, 35, 90, 0.2}, {14, 35, 270, 0.2}}},
        // A ridge of one metre is a peak; half a metre more is not.
        TypeCase{"pyramidal",
                 {{25, 35, 0, 0.2, false, 3, 6, 1},
                  {25, 35, 180, 0.2, false, 3, 6, 1},
                  {25, 35, 90, 0.2},
                  {25, 35, 270, 0.2}}},
        TypeCase{"hipped",
                 {{25, 35, 0, 0.2, false, 3, 6, 1.5},
                  {25, 35, 180, 0.2, false, 3, 6, 1.5},
                  {25, 35, 90, 0.2},
                  {25, 35, 270, 0.2}}},
        // The gentle faces stand on the steep ones; below, they belong to another house of the row.
        TypeCase{"mansard",
                 {{30, 60, 0, 1, false, 3, 6},
                  {20, 25, 0, 1, false, 6, 8},
                  {30, 60, 180, 1, false, 3, 6},
                  {20, 25, 180, 1, false, 6, 8}}},
        TypeCase{"gabled",
                 {{30, 60, 0, 1, false, 3, 8},
                  {20, 25, 0, 1, false, 3, 6},
                  {30, 60, 180, 1, false, 3, 8},
                  {20, 25, 180, 1, false, 3, 6}}},
        // The steep side of a dormer does not bend a roof.
        TypeCase{"gabled",
                 {{2, 60, 0, 1, false, 3, 6}, {48, 25, 0, 1, false, 6, 8}, {50, 25, 180, 1, false, 6, 8}}},
        // A cone in six pieces is round, or has sides that are not at right angles.
        TypeCase{"domed",
                 {{17, 40, 0, 0.2},
                  {17, 40, 60, 0.2},
                  {17, 40, 120, 0.2},
                  {17, 40, 180, 0.2},
                  {16, 40, 240, 0.2},
                  {16, 40, 300, 0.2}}},
        TypeCase{
            "domed", {{25, 35, 0, 0.2}, {25, 35, 180, 0.2}, {25, 35, 90, 0.2}, {25, 35, 270, 0.2}}, 0.95},
        TypeCase{"complex", {{30, 35, 0}, {20, 35, 180}, {50, 0, 0}}},
        TypeCase{"complex", {{50, 35, 0}, {50, 35, 90}}}));

TEST(RoofTypeOfCells, APeakIsAtLeastAsLongAsACell) {
    const std::vector<FaceShape> faces{{25, 35, 0, 0.2, false, 3, 6, 2},
                                       {25, 35, 180, 0.2, false, 3, 6, 2},
                                       {25, 35, 90, 0.2},
                                       {25, 35, 270, 0.2}};
    EXPECT_EQ(roof_type(faces, 0.75, 1), "hipped");
    EXPECT_EQ(roof_type(faces, 0.75, 2), "pyramidal");
}

}  // namespace
}  // namespace d2b::roofs
