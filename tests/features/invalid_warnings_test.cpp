#include <gtest/gtest.h>

#include "features/feature_writer.hpp"

namespace d2b::features {
namespace {

FeaturePolygon made(const std::string& invalid_reason, OutlineStatus status, bool written) {
    FeaturePolygon result;
    result.invalid_reason = invalid_reason;
    result.status = status;
    if (written)
        result.parts = {{{{0, 0}, {2, 0}, {2, 2}}, {}}};
    return result;
}

TEST(InvalidWarnings, FeaturesAreNamedWithWhatBecameOfThem) {
    Context context;
    InvalidWarnings warnings(context);
    warnings.note("Building", 7, made("Ring Self-intersection[3 4]", OutlineStatus::kept_traced, true));
    warnings.note("Building", 8, made("", OutlineStatus::traced, true));
    warnings.note("Contour", 19, made("Self-intersection[1 1]", OutlineStatus::repaired, true));
    warnings.note("Contour", 20, made("Too few points", OutlineStatus::repaired, false));
    warnings.finish();
    EXPECT_EQ(context.report.warnings,
              (std::vector<std::string>{
                  "Building 7 would not have been a valid polygon (Ring Self-intersection[3 4]); it is "
                  "written as it "
                  "was traced.",
                  "Contour 19 would not have been a valid polygon (Self-intersection[1 1]); a repaired one "
                  "is written.",
                  "Contour 20 would not have been a valid polygon (Too few points); it is not written."}));
}

TEST(InvalidWarnings, ManyAreCounted) {
    Context context;
    InvalidWarnings warnings(context);
    for (int id = 1; id <= 13; ++id)
        warnings.note("Contour", id, made("Self-intersection[1 1]", OutlineStatus::repaired, true));
    warnings.finish();
    ASSERT_EQ(context.report.warnings.size(), 11U);
    EXPECT_EQ(context.report.warnings.back(),
              "3 more features would not have been valid polygons; -write_rejected writes them all, with the "
              "reason.");
}

}  // namespace
}  // namespace d2b::features
