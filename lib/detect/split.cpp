#include "detect/split.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "detect/element.hpp"
#include "detect/piece_cells.hpp"
#include "detect/piece_graph.hpp"
#include "detect/piece_labels.hpp"
#include "detect/regions.hpp"

namespace d2b {
namespace {

/// Blurred walls of two or three cells are narrower, wings of houses are wider.
constexpr double narrow_radius_m = 1.5;

/// Labels parts of buildings without a step.
Regions stepless_pieces(const Scene& scene, float split_height, const Detection& detection,
                        Executor& threads) {
    const CellValues<Label>& labels = detection.labels.values;
    const CellValues<float>& surface = scene.surface.values;
    return joined_regions(
        building_cells(detection),
        [&](std::size_t i, std::size_t j) {
            // False for NaN: such a cell belongs to either side, and is merged later.
            return labels[i] == labels[j] && std::abs(surface[i] - surface[j]) <= split_height;
        },
        threads);
}

void add_cells(const Scene& scene, const Regions& regions, PieceGraph& graph) {
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r)) {
            PieceGraph::Piece& piece = graph.piece(run.label);
            piece.cells += run.end - run.begin;
            for (std::int32_t c = run.begin; c < run.end; ++c)
                if (const float z = scene.surface.at(r, c); !std::isnan(z)) {
                    ++piece.heights;
                    piece.height_sum += static_cast<double>(z);
                }
        }
}

void mark_wide(const Grid<Label>& pieces, const Regions& regions, const Element& element, PieceGraph& graph) {
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r)) {
            bool& wide = graph.piece(run.label).wide;
            for (std::int32_t c = run.begin; c < run.end && !wide; ++c)
                wide = fits(pieces, element, r, c);
        }
}

}  // namespace

void split_buildings(const Scene& scene, double split_height, std::int64_t least_cells, Detection& detection,
                     Executor& threads) {
    const Regions regions = stepless_pieces(scene, static_cast<float>(split_height), detection, threads);
    if (regions.count() == 0)
        return;
    PieceGraph graph(regions.count(), scene.cell);
    add_cells(scene, regions, graph);
    {
        const Grid<Label> pieces = piece_grid(regions, threads);
        add_borders(pieces, detection.labels, graph);
        mark_wide(pieces, regions, disk_element(narrow_radius_m, scene.cell), graph);
    }
    graph.merge_small(least_cells);
    write_pieces(regions, graph.numbered(), detection);
}

}  // namespace d2b
