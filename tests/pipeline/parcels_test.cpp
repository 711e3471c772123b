#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/parcel_source.hpp"
#include "pipeline/block_town.hpp"
#include "pipeline/run.hpp"
#include "pipeline/tiles_case.hpp"
#include "surface/surface_check.hpp"

namespace d2b::test {
namespace {

/// Parcels that are a function of the cell.
class MadeParcels final : public ParcelSource {
  public:
    using Of = std::function<std::int64_t(std::int32_t, std::int32_t)>;
    explicit MadeParcels(Of of) : of_(std::move(of)) {}

    void read(const Window& part, std::span<ParcelCell> cells) override {
        for (std::int32_t r = 0; r < part.rows; ++r)
            for (std::int32_t c = 0; c < part.cols; ++c)
                cells[static_cast<std::size_t>(r) * static_cast<std::size_t>(part.cols) +
                      static_cast<std::size_t>(c)]
                    .parcel = of_(part.row + r, part.col + c);
    }
    std::string_view name(std::int64_t parcel) override {
        return parcel == ParcelCell::no_parcel ? std::string_view()
                                               : *names_.insert("lot " + std::to_string(parcel)).first;
    }

  private:
    Of of_;
    std::set<std::string> names_;
};

/// Strips that lean, 11 m wide, each in two halves.
std::int64_t leaning(std::int32_t row, std::int32_t col) {
    const int strip = static_cast<int>(std::floor((col + 0.5 + 0.31 * (row + 0.5)) / 11));
    return 2 * strip + (row < 150 ? 0 : 1);
}

/// Terraces over the seams of units of 100 x 100 cells.
BlockTown terraces() {
    BlockTown town(300, 300);
    for (const Box& box : {Box{90, 30, 20, 150}, Box{140, 40, 24, 220}, Box{190, 90, 14, 120},
                           Box{204, 180, 60, 16}, Box{30, 60, 14, 30}})
        town.build(box, 7);
    town.build({90, 180, 20, 40}, 11);
    return town;
}

Options options_of(double split_height = 0) {
    Options options;
    options.ground.max_building_width = 30;
    options.detect.split_by = "lots";
    options.detect.split_height = split_height;
    options.write.doubtful = true;
    return options;
}

struct ParcelRun {
    explicit ParcelRun(const Options& options) {
        place_in_utm(dem, 1);
        result.report = pipeline::run_in_units(options, {dem, nullptr, nullptr, nullptr, &parcels},
                                               {result.sink}, {}, {});
    }
    MemorySource dem = terraces().source();
    MadeParcels parcels{leaning};
    Result result;
};

using MapPoint = std::pair<double, double>;
std::vector<std::pair<MapPoint, MapPoint>> edges_of(const Feature& feature) {
    std::vector<std::pair<MapPoint, MapPoint>> edges;
    const auto add = [&](const WorldRing& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Position& a = ring[i];
            const Position& b = ring[(i + 1) % ring.size()];
            edges.push_back({{a.x, a.y}, {b.x, b.y}});
        }
    };
    for (const WorldPolygon& part : feature.parts) {
        add(part.exterior);
        for (const WorldRing& ring : part.interiors)
            add(ring);
    }
    return edges;
}

std::set<MapPoint> corners_of(const Feature& feature) {
    std::set<MapPoint> corners;
    for (const auto& edge : edges_of(feature))
        corners.insert(edge.first);
    return corners;
}

/// All corners of the one are corners of the other. Its additional ones are corners of higher contours that
/// touch it, its own or its neighbours'.
void expect_corners_of(const Feature& house, const Feature& contour, const std::set<MapPoint>& higher) {
    const std::set<MapPoint> corners = corners_of(contour);
    const std::set<MapPoint> expected = corners_of(house);
    EXPECT_TRUE(std::ranges::includes(corners, expected));
    for (const MapPoint& corner : corners)
        EXPECT_TRUE(expected.contains(corner) || higher.contains(corner));
    EXPECT_NEAR(area_of(house.parts), area_of(contour.parts), 0.05);
}

/// A house's outline is that of its contour of level 1, and every wall is shared whole or not at all.
TEST(Parcels, HousesShareTheirWallsVertexForVertex) {
    const ParcelRun run(options_of());
    const auto& sink = run.result.sink;
    const auto& houses = sink.features.at(buildings);
    ASSERT_GT(houses.size(), 40U);
    std::map<std::int64_t, const Feature*> base;
    std::set<MapPoint> higher;
    for (const Feature& contour : sink.features.at(contours))
        if (const auto& record = std::get<ContourRecord>(contour.record); record.level == 1)
            base[record.building_id] = &contour;
        else
            higher.merge(corners_of(contour));
    std::set<std::pair<MapPoint, MapPoint>> edges;
    std::size_t shared = 0;
    double area = 0;
    for (const Feature& house : houses) {
        const auto& record = std::get<BuildingRecord>(house.record);
        ASSERT_TRUE(base.contains(record.id));
        expect_corners_of(house, *base[record.id], higher);
        EXPECT_TRUE(record.parcel.starts_with("lot "));
        EXPECT_GT(record.heights_m[2], 6);
        EXPECT_GE(record.area_m2, 10);
        area += record.area_m2;
        for (const auto& edge : edges_of(house)) {
            EXPECT_TRUE(edges.insert(edge).second);  // nobody else has it this way round
            shared += edges.contains({edge.second, edge.first}) ? 1U : 0U;
        }
    }
    EXPECT_GT(shared, houses.size() / 2);
    // They cover the blocks, and no place twice.
    Options whole = options_of();
    whole.detect.split_by = "";
    MemorySource dem = terraces().source();
    place_in_utm(dem, 1);
    Result blocks;
    blocks.report = pipeline::run_in_units(whole, {dem}, {blocks.sink}, {}, {});
    double expected = 0;
    for (const Feature& block : blocks.sink.features.at(buildings))
        expected += std::get<BuildingRecord>(block.record).area_m2;
    EXPECT_NEAR(area, expected, 0.01 * expected);
}

/// The walls that stand where parcels meet.
TEST(Parcels, WallsLieWithinHalfACellOfTheCuts) {
    const ParcelRun run(options_of());
    const auto& sink = run.result.sink;
    std::set<std::pair<MapPoint, MapPoint>> edges;
    for (const Feature& house : sink.features.at(buildings))
        for (const auto& edge : edges_of(house))
            edges.insert(edge);
    std::vector<double> distances;
    for (const auto& edge : edges) {
        if (!edges.contains({edge.second, edge.first}))
            continue;
        for (const MapPoint& end : {edge.first, edge.second}) {
            const double col = end.first - 600000;
            const double row = 5800000 - end.second;
            const double across = (col + 0.31 * row) / 11;
            const bool beside_other = std::abs(row - 150) < 3 || std::abs(col - 180) < 3;  // halves, the step
            if (!beside_other)
                distances.push_back(std::abs(across - std::round(across)) * 11 / std::hypot(1, 0.31));
        }
    }
    ASSERT_GT(distances.size(), 60U);
    std::ranges::sort(distances);
    EXPECT_LT(distances[distances.size() * 9 / 10], 0.5);
    EXPECT_LT(distances.back(), 1);
}

TEST(Parcels, AreReported) {
    const ParcelRun run(options_of());
    const RunReport& report = run.result.report;
    ASSERT_TRUE(report.parcels);
    EXPECT_EQ(report.parcels->inside_m2, report.parcels->building_m2);
    EXPECT_EQ(report.parcels->overlap_m2, 0);
    EXPECT_EQ(report.parcels->invalid_m2, 0);
    EXPECT_GT(report.parcels->cut_length_m, 500);
    EXPECT_GT(report.counted(Reason::part_merged), 0);
    for (const std::string& warning : report.warnings)
        ADD_FAILURE() << warning;
}

/// Units, tiles and threads make no difference.
TEST(Parcels, CutTheSameInTilesAsInOneRun) {
    for (const double split : {0.0, 3.0}) {
        const Options options = options_of(split);
        MemorySource dem = terraces().source();
        place_in_utm(dem, 1);
        MadeParcels parcels(leaning);
        const Sources sources{dem, nullptr, nullptr, nullptr, &parcels};
        const detect::UnitSize units{0, 100};
        Result whole;
        whole.report = pipeline::run_in_units(options, sources, {whole.sink}, {}, units);
        EXPECT_GT(whole.report.buildings, 40);
        for (const std::int32_t side : {1, 2}) {
            TemporaryFolder folder;
            Result tiles;
            StepsInTiles(sources, options, {folder.path(), 7, side, units})
                .run({side, side == 2, false, 2}, tiles);
            expect_same(tiles, whole);
            ASSERT_TRUE(tiles.report.parcels);
            EXPECT_EQ(tiles.report.parcels->cut_length_m, whole.report.parcels->cut_length_m);
            EXPECT_EQ(tiles.report.parcels->median_distance_m, whole.report.parcels->median_distance_m);
            ASSERT_EQ(tiles.report.parcels->best_offset.has_value(),
                      whole.report.parcels->best_offset.has_value());
            EXPECT_EQ(tiles.report.counted(Reason::part_merged), whole.report.counted(Reason::part_merged));
        }
    }
}

TEST(Parcels, SurfacesStayClosed) {
    for (const SurfaceOf of : {SurfaceOf::buildings, SurfaceOf::contours}) {
        Options options = options_of();
        options.write.surfaces = {"s.obj"};
        options.write.surface_of = of;
        MemorySource dem = terraces().source();
        place_in_utm(dem, 1);
        MadeParcels parcels(leaning);
        MemorySink sink;
        MemorySurface shell;
        MemorySurface solids{SurfaceForm::solids};
        const RunReport report = run(options, {dem, nullptr, nullptr, nullptr, &parcels},
                                     {sink, nullptr, nullptr, nullptr, nullptr, {&shell, &solids}});
        EXPECT_EQ(surface::fault_of(shell.parts), "");
        for (const SurfacePart& solid : solids.parts)
            EXPECT_EQ(surface::fault_of({&solid, 1}), "");
        EXPECT_EQ(static_cast<std::int64_t>(solids.parts.size()), report.buildings);
        EXPECT_LT(shell.parts.size(), solids.parts.size() / 2);
        EXPECT_EQ(solids.meta.fields.back().name, "parcel");
    }
}

std::string warning_of(const MadeParcels::Of& of) {
    MemorySource dem = terraces().source();
    place_in_utm(dem, 1);
    MadeParcels parcels(of);
    MemorySink sink;
    std::string heard;
    Callbacks callbacks;
    callbacks.on_warning = [&](const std::string& text) { heard += text; };
    static_cast<void>(run(options_of(), {dem, nullptr, nullptr, nullptr, &parcels}, {sink}, callbacks));
    return heard;
}

/// Lots of the terrace's houses, the whole of which lies three metres beside them.
TEST(Parcels, AreDoubtedWhereTheyAreDisplaced) {
    const auto moved = [](std::int32_t by) {
        return [by](std::int32_t r, std::int32_t c) -> std::int64_t {
            r -= by;
            const bool in_the_row = r >= 140 && r < 164 && c >= 40 && c < 260;
            return in_the_row ? c / 20 : ParcelCell::no_parcel;
        };
    };
    EXPECT_EQ(warning_of(moved(0)), "");
    EXPECT_TRUE(warning_of(moved(3)).starts_with(
        "Parcels of 'lots' lie 3 m off the walls as a whole: they fit best if they are moved 3 m up on "));
    EXPECT_TRUE(warning_of([](std::int32_t, std::int32_t) {
                    return ParcelCell::no_parcel;
                }).starts_with("No parcel of 'lots' touches a building, so none was cut; "));
}

}  // namespace
}  // namespace d2b::test
