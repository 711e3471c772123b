#include "features/troubles.hpp"

#include <gtest/gtest.h>

namespace d2b {
namespace {

Placed placed(const std::string& trouble, OutlineStatus status, bool written) {
    Placed result;
    result.trouble = trouble;
    result.status = status;
    if (written)
        result.parts = {{{{0, 0}, {2, 0}, {2, 2}}, {}}};
    return result;
}

TEST(Troubles, FeaturesAreNamedWithWhatBecameOfThem) {
    Context context;
    Troubles troubles(context);
    troubles.note("Building", 7, placed("Ring Self-intersection[3 4]", OutlineStatus::kept_traced, true));
    troubles.note("Building", 8, placed("", OutlineStatus::traced, true));
    troubles.note("Contour", 19, placed("Self-intersection[1 1]", OutlineStatus::repaired, true));
    troubles.note("Contour", 20, placed("Too few points", OutlineStatus::repaired, false));
    troubles.finish();
    EXPECT_EQ(context.report.warnings,
              (std::vector<std::string>{
                  "Building 7 would not have been a valid polygon (Ring Self-intersection[3 4]); it is "
                  "written as it "
                  "was traced.",
                  "Contour 19 would not have been a valid polygon (Self-intersection[1 1]); it is written "
                  "repaired.",
                  "Contour 20 would not have been a valid polygon (Too few points); it is not written."}));
}

TEST(Troubles, ManyAreCounted) {
    Context context;
    Troubles troubles(context);
    for (int id = 1; id <= 13; ++id)
        troubles.note("Contour", id, placed("Self-intersection[1 1]", OutlineStatus::repaired, true));
    troubles.finish();
    ASSERT_EQ(context.report.warnings.size(), 11U);
    EXPECT_EQ(context.report.warnings.back(),
              "3 more features would not have been valid polygons; -write_rejected writes them all, with "
              "what became "
              "of them.");
}

}  // namespace
}  // namespace d2b
