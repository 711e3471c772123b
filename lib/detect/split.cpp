#include "detect/split.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "detect/element.hpp"
#include "detect/piece_graph.hpp"
#include "detect/regions.hpp"

namespace d2b {
namespace {

/// Walls that the raster smears over two or three cells are narrower, wings of houses are wider.
constexpr double narrow_radius_m = 1.5;

/// Stretches of buildings without a step.
Regions stepless_pieces(const Scene& scene, float split_height, const Detection& detection,
                        Executor& threads) {
    const std::vector<Label>& labels = detection.labels.values;
    Mask cells(detection.labels.rows, detection.labels.cols);
    for (std::size_t i = 0; i < cells.size(); ++i)
        cells.values[i] = labels[i] != 0 && labels[i] <= detection.buildings ? 1 : 0;
    const std::vector<float>& surface = scene.surface.values;
    return joined_regions(
        cells,
        [&](std::size_t i, std::size_t j) {
            // False where one is NaN: such a cell belongs to either side, and is merged later.
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

/// Pieces touch where neighbouring cells of one building are of two.
void add_borders(const Grid<Label>& pieces, const Grid<Label>& buildings, PieceGraph& graph) {
    const auto pair = [&](std::size_t i, std::size_t j, bool beside) {
        if (pieces.values[i] != 0 && pieces.values[j] != 0 && pieces.values[i] != pieces.values[j] &&
            buildings.values[i] == buildings.values[j])
            graph.add_pair(pieces.values[i], pieces.values[j], beside);
    };
    for (std::int32_t r = 0; r < pieces.rows; ++r)
        for (std::int32_t c = 0; c < pieces.cols; ++c) {
            const std::size_t i = pieces.index(r, c);
            if (c > 0)
                pair(i - 1, i, true);
            if (r > 0)
                pair(i - static_cast<std::size_t>(pieces.cols), i, false);
        }
}

/// Whether the element fits into the cell's piece; the border continues outwards.
bool fits(const Grid<Label>& pieces, const Element& element, std::int32_t r, std::int32_t c) {
    return std::all_of(element.begin(), element.end(), [&](const ElementRow& part) {
        const std::int32_t y = std::clamp(r + part.down, 0, pieces.rows - 1);
        const auto row = pieces.row(y).begin();
        return std::all_of(row + std::max(c + part.left, 0), row + std::min(c + part.right + 1, pieces.cols),
                           [&](Label label) { return label == pieces.at(r, c); });
    });
}

void mark_wide(const Grid<Label>& pieces, const Regions& regions, const Element& element, PieceGraph& graph) {
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r)) {
            bool& wide = graph.piece(run.label).wide;
            for (std::int32_t c = run.begin; c < run.end && !wide; ++c)
                wide = fits(pieces, element, r, c);
        }
}

/// @param number of the regions' labels
void write_pieces(const Regions& regions, const std::vector<Label>& number, Detection& detection) {
    const Label pieces = *std::max_element(number.begin(), number.end());
    std::vector<DetectedObject> objects(pieces);
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r)) {
            const std::span<Label> cells = detection.labels.row(r).subspan(
                static_cast<std::size_t>(run.begin), static_cast<std::size_t>(run.end - run.begin));
            const Label label = number[run.label];
            DetectedObject& object = objects[label - 1];
            if (object.cells == 0) {
                object = detection.objects[cells.front() - 1];
                object.cells = 0;
            }
            object.cells += run.end - run.begin;
            std::fill(cells.begin(), cells.end(), label);
        }
    objects.insert(objects.end(), detection.objects.begin() + detection.buildings, detection.objects.end());
    detection.objects = std::move(objects);
    detection.buildings = pieces;
}

/// Makes room for more buildings before the doubtful objects.
void shift_doubtful(Detection& detection, Label buildings) {
    for (Label& label : detection.labels.values)
        if (label > detection.buildings)
            label += buildings - detection.buildings;
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
        std::vector<Label> itself(regions.cells.size());
        std::iota(itself.begin(), itself.end(), Label{0});
        const Grid<Label> pieces = label_grid(regions, itself, threads);
        add_borders(pieces, detection.labels, graph);
        mark_wide(pieces, regions, disk_element(narrow_radius_m, scene.cell), graph);
    }
    graph.merge_small(least_cells);
    const std::vector<Label> number = graph.numbered();
    shift_doubtful(detection, *std::max_element(number.begin(), number.end()));
    write_pieces(regions, number, detection);
}

}  // namespace d2b
