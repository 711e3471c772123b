#include <algorithm>
#include <vector>

#include "view/field.hpp"
#include "view/map_page.hpp"
#include "view/pixels.hpp"

namespace d2b::test {
namespace {

std::vector<TrialPicture> trials(const MapArea& ground, const SheetPlan& plan) {
    std::vector<TrialPicture> all;
    for (std::size_t i = 0; i < plan.trials; ++i) {
        const MapFrame frame(ground, map_size_on_sheet(ground, plan));
        MapPicture map{frame,
                       std::make_shared<Relief>(frame),
                       FootprintDrawing(frame, PictureFormat::png),
                       "Height",
                       {}};
        const std::vector<float> level(
            static_cast<std::size_t>(ground.dem.rows) * static_cast<std::size_t>(ground.dem.cols), 5);
        map.relief->write(ground.dem.window, level);
        all.push_back({"lod " + std::to_string(i), std::move(map)});
    }
    return all;
}

TEST(ContactSheet, HasARowForWhatBelongsTogetherWhereThereIsRoom) {
    EXPECT_EQ(plan_sheet(9, 3, 1600).columns, 3);
    EXPECT_EQ(plan_sheet(8, 2, 1600).columns, 2);
    EXPECT_EQ(plan_sheet(8, 4, 1600).columns, 4);
    EXPECT_EQ(plan_sheet(6, 6, 1600).columns, 3);   // no room for six
    EXPECT_EQ(plan_sheet(16, 1, 1600).columns, 4);  // nor for sixteen below each other
    EXPECT_EQ(plan_sheet(12, 6, 2400).columns, 6);
    EXPECT_EQ(plan_sheet(1, 1, 200).columns, 1);
}

TEST(ContactSheet, IsAsLongAsAskedForAndItsMapsAreLegible) {
    for (const auto& [rows, cols] : {std::pair{30, 30}, {20, 60}, {60, 20}})
        for (const std::size_t count : {1U, 2U, 5U, 9U, 16U}) {
            const MapArea ground = field(rows, cols, Crs("EPSG:25833"));
            const SheetPlan plan = plan_sheet(count, 1, 1600);
            const Pixels sheet(draw_contact_sheet(trials(ground, plan), plan, PictureFormat::png));
            EXPECT_EQ(std::max(sheet.width(), sheet.height()), 1600);
            const PixelSize map = map_size_on_sheet(ground, plan);
            EXPECT_GE(std::max(map.width, map.height), 240) << count << " of " << rows << " x " << cols;
            EXPECT_NEAR(static_cast<double>(map.width) / cols, static_cast<double>(map.height) / rows, 0.5);
        }
}

TEST(ContactSheet, HasACaptionAboveEachMap) {
    const MapArea ground = field(30, 30, Crs("EPSG:25833"));
    const SheetPlan plan = plan_sheet(5, 1, 1200);
    ASSERT_EQ(plan.columns, 3);
    const Pixels sheet(draw_contact_sheet(trials(ground, plan), plan, PictureFormat::png));
    const PixelSize map = map_size_on_sheet(ground, plan);
    int maps = 0;
    for (int i = 0; i < 6; ++i) {
        const int left = 10 + i % 3 * (sheet.width() / 3);
        const int top = i / 3 * (map.height + 40);
        maps += sheet.dark(left, top, left + 200, top + 40) > 50 ? 1 : 0;
    }
    EXPECT_EQ(maps, 5);
    EXPECT_EQ(sheet.at(100, 300), level_ground);
}

}  // namespace
}  // namespace d2b::test
