#include "roofs/roof_type.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace d2b::roofs {
namespace {

struct TypeCase {
    std::string type;
    std::vector<FaceShape> faces;
};

class RoofType : public testing::TestWithParam<TypeCase> {};

TEST_P(RoofType, IsThatOfItsFaces) {
    std::vector<FaceShape> faces = GetParam().faces;
    EXPECT_EQ(roof_type(faces), GetParam().type);
    // Whatever the direction of the building, and of its rows.
    for (const double turn : {17.0, 90.0, 201.5}) {
        std::vector<FaceShape> turned = faces;
        for (FaceShape& face : turned)
            face.azimuth += turn;
        EXPECT_EQ(roof_type(turned), GetParam().type) << turn;
    }
    for (FaceShape& face : faces)
        face.azimuth = -face.azimuth;
    EXPECT_EQ(roof_type(faces), GetParam().type);
}

INSTANTIATE_TEST_SUITE_P(
    Table, RoofType,
    testing::Values(TypeCase{"unknown", {}}, TypeCase{"unknown", {{60, 0, 0, true}, {40, 30, 0}}},
                    TypeCase{"flat", {{100, 2, 0}}}, TypeCase{"flat", {{80, 0, 0}, {20, 30, 90}}},
                    TypeCase{"flat", {{50, 0, 0}, {50, 3, 140}}}, TypeCase{"shed", {{100, 20, 90}}},
                    TypeCase{"shed", {{80, 20, 90}, {20, 1, 0}}},
                    TypeCase{"gabled", {{50, 35, 0}, {50, 35, 180}}},
                    TypeCase{"gabled", {{60, 35, 10}, {40, 40, 195}}},
                    TypeCase{"gabled", {{48, 35, 0}, {48, 35, 180}, {4, 0, 0}}},
                    TypeCase{"hipped", {{36, 35, 0}, {36, 35, 180}, {14, 35, 90}, {14, 35, 270}}},
                    TypeCase{"pyramidal", {{25, 35, 0}, {25, 35, 180}, {25, 35, 90}, {25, 35, 270}}},
                    TypeCase{"mansard", {{30, 60, 0}, {20, 25, 0}, {30, 60, 180}, {20, 25, 180}}},
                    TypeCase{"complex", {{40, 35, 0}, {20, 35, 180}, {40, 0, 0}}},
                    TypeCase{"complex", {{50, 35, 0}, {50, 35, 90}}}));

}  // namespace
}  // namespace d2b::roofs
