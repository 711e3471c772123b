#include "pipeline/tiles_case.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "pipeline/run.hpp"

namespace d2b::test {
namespace {

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

bool same(const FieldValue& a, const FieldValue& b) {
    if (a.index() != b.index())
        return false;
    const auto* number = std::get_if<double>(&a);
    return number != nullptr ? same(*number, std::get<double>(b)) : a == b;
}

void expect_same(const std::vector<WorldPolygon>& a, const std::vector<WorldPolygon>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].exterior, b[i].exterior);
        EXPECT_EQ(a[i].interiors, b[i].interiors);
        EXPECT_EQ(a[i].arcs.size(), b[i].arcs.size());
        EXPECT_EQ(a[i].elevations, b[i].elevations);
    }
}

void expect_same(const Feature& a, const Feature& b) {
    ASSERT_EQ(a.values.size(), b.values.size());
    for (std::size_t i = 0; i < a.values.size(); ++i)
        EXPECT_TRUE(same(a.values[i], b.values[i])) << "field " << i;
    EXPECT_TRUE(same(a.z, b.z));
    expect_same(a.parts, b.parts);
}

void expect_same(const OutlineLength& a, const OutlineLength& b) {
    EXPECT_EQ(a.fitted, b.fitted);
    EXPECT_EQ(a.simplified, b.simplified);
    EXPECT_EQ(a.traced, b.traced);
}

void expect_same(const RunReport& a, const RunReport& b) {
    EXPECT_EQ(a.dropped, b.dropped);
    EXPECT_EQ(a.warnings, b.warnings);
    EXPECT_EQ(a.input, b.input);
    EXPECT_EQ(a.valid_points, b.valid_points);
    EXPECT_TRUE(same(a.minimum, b.minimum));
    EXPECT_TRUE(same(a.maximum, b.maximum));
    EXPECT_TRUE(same(a.mean, b.mean));
    EXPECT_TRUE(same(a.standard_deviation, b.standard_deviation));
    EXPECT_EQ(a.contours, b.contours);
    EXPECT_EQ(a.buildings, b.buildings);
    EXPECT_EQ(a.doubtful, b.doubtful);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.stack_rmse_m, b.stack_rmse_m);
    expect_same(a.building_outlines, b.building_outlines);
    expect_same(a.contour_outlines, b.contour_outlines);
    ASSERT_EQ(a.roofs.has_value(), b.roofs.has_value());
    if (a.roofs) {
        EXPECT_EQ(a.roofs->flat, b.roofs->flat);
        EXPECT_EQ(a.roofs->pitched, b.roofs->pitched);
        EXPECT_EQ(a.roofs->doubtful, b.roofs->doubtful);
        EXPECT_EQ(a.roofs->area_m2, b.roofs->area_m2);
        EXPECT_EQ(a.roofs->doubtful_area_m2, b.roofs->doubtful_area_m2);
        EXPECT_EQ(a.roofs->level, b.roofs->level);
    }
    ASSERT_EQ(a.sampling.has_value(), b.sampling.has_value());
    if (a.sampling) {
        EXPECT_EQ(a.sampling->interpolated_fraction, b.sampling->interpolated_fraction);
        EXPECT_EQ(a.sampling->points_per_cell, b.sampling->points_per_cell);
        EXPECT_EQ(a.sampling->edge_width_cells, b.sampling->edge_width_cells);
        EXPECT_EQ(a.sampling->value_step, b.sampling->value_step);
    }
    ASSERT_EQ(a.footprints.has_value(), b.footprints.has_value());
    if (a.footprints) {
        EXPECT_EQ(a.footprints->given, b.footprints->given);
        EXPECT_EQ(a.footprints->measured, b.footprints->measured);
        EXPECT_EQ(a.footprints->outside, b.footprints->outside);
        EXPECT_EQ(a.footprints->without_cell, b.footprints->without_cell);
        EXPECT_EQ(a.footprints->without_polygon, b.footprints->without_polygon);
        EXPECT_EQ(a.footprints->without_data, b.footprints->without_data);
        EXPECT_EQ(a.footprints->invalid, b.footprints->invalid);
        EXPECT_EQ(a.footprints->flat, b.footprints->flat);
        EXPECT_EQ(a.footprints->missing, b.footprints->missing);
    }
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t i = 0; i < a.levels.size(); ++i) {
        EXPECT_TRUE(same(a.levels[i].threshold, b.levels[i].threshold));
        EXPECT_EQ(a.levels[i].contours, b.levels[i].contours);
        EXPECT_EQ(a.levels[i].points, b.levels[i].points);
    }
}

}  // namespace

std::int64_t StepsInTiles::count() {
    tiles::PlannedSink sink(layers_);
    return tiles::TileRun(work_, options_, sources_, sink, {}).tiles().count();
}

void StepsInTiles::plan() {
    tiles::PlannedSink sink(layers_);
    tiles::TileRun run(work_, options_, sources_, sink, {});
    tiles::plan_footprints(run);
}

void StepsInTiles::find(std::int64_t tile) {
    tiles::PlannedSink sink(layers_);
    tiles::TileRun run(work_, options_, sources_, sink, {});
    tiles::find_tile(run, tile);
}

void StepsInTiles::join() {
    tiles::PlannedSink sink(layers_);
    tiles::TileRun run(work_, options_, sources_, sink, {});
    tiles::join_tiles(run);
}

void StepsInTiles::draw(std::int64_t tile) {
    tiles::PlannedSink sink(layers_);
    tiles::TileRun run(work_, options_, sources_, sink, {});
    tiles::draw_tile(run, tile);
}

void StepsInTiles::merge(Result& result) {
    tiles::TileRun run(work_, options_, sources_, result.sink, {});
    result.report = tiles::merge_tiles(run, result.sink);
}

void StepsInTiles::number_and_write(Result& result) {
    {
        tiles::PlannedSink sink(layers_);
        tiles::TileRun run(work_, options_, sources_, sink, {});
        EXPECT_FALSE(tiles::are_numbered(run));
        result.report = tiles::number_tiles(run);
        EXPECT_TRUE(tiles::are_numbered(run));
    }
    for (std::int64_t tile = count(); tile-- > 0;) {
        MemorySink part;
        tiles::TileRun run(work_, options_, sources_, part, {});
        EXPECT_FALSE(tiles::written_totals(run, tile));
        tiles::write_tile(run, tile, part);
        result.sink.features.resize(part.features.size());
        for (std::size_t layer = 0; layer < part.features.size(); ++layer)
            std::ranges::move(part.features[layer], std::back_inserter(result.sink.features[layer]));
        result.sink.provenance = part.provenance;
        result.sink.finished = part.finished;
        const std::optional<tiles::NumberedWhole> whole = tiles::written_totals(run, tile);
        EXPECT_EQ(whole.has_value(), tile == 0);
        for (std::size_t layer = 0; whole && layer < whole->layers.size(); ++layer)
            EXPECT_EQ(whole->layers[layer].features, std::ssize(result.sink.features[layer]));
    }
    for (std::vector<Feature>& layer : result.sink.features)
        std::ranges::sort(layer, {},
                          [](const Feature& feature) { return std::get<std::int64_t>(feature.values[0]); });
}

template <typename Step>
void StepsInTiles::each(const TileOrder& order, const Step& step) {
    const std::int64_t tiles = count();
    for (int time = 0; time < (order.twice ? 2 : 1); ++time)
        for (std::int64_t i = 0; i < tiles; ++i)
            step(order.backwards ? tiles - 1 - i : i);
}

void StepsInTiles::run(const TileOrder& order, Result& result) {
    options_.run.threads = order.threads;
    work_.side = order.side;
    plan();
    each(order, [&](std::int64_t tile) { find(tile); });
    join();
    each(order, [&](std::int64_t tile) { draw(tile); });
    merge(result);
}

void expect_same(const Result& a, const Result& b) {
    EXPECT_EQ(a.sink.finished, b.sink.finished);
    EXPECT_EQ(a.sink.provenance.metadata, b.sink.provenance.metadata);
    EXPECT_EQ(a.sink.provenance.crs_wkt, b.sink.provenance.crs_wkt);
    ASSERT_EQ(a.sink.features.size(), b.sink.features.size());
    for (std::size_t layer = 0; layer < a.sink.features.size(); ++layer) {
        ASSERT_EQ(a.sink.features[layer].size(), b.sink.features[layer].size()) << "layer " << layer;
        for (std::size_t i = 0; i < a.sink.features[layer].size() && !testing::Test::HasFailure(); ++i) {
            SCOPED_TRACE("layer " + std::to_string(layer) + ", feature " + std::to_string(i));
            expect_same(a.sink.features[layer][i], b.sink.features[layer][i]);
        }
    }
    expect_same(a.report, b.report);
}

void expect_same_in_tiles(const Sources& sources, const Options& options, const detect::UnitSize& units,
                          const TileOrder& order, Result& whole) {
    whole.report = pipeline::run_in_units(options, sources, {whole.sink}, {}, units);
    const TemporaryFolder folder;
    Result tiles;
    StepsInTiles steps(sources, options, {folder.path(), some_plan, 1, units});
    steps.run(order, tiles);
    expect_same(tiles, whole);
    Result parts;
    steps.number_and_write(parts);
    expect_same(parts, whole);
}

}  // namespace d2b::test
