#include "detect/cut_by_parcels.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "detect/piece_cells.hpp"
#include "detect/piece_graph.hpp"
#include "detect/piece_labels.hpp"
#include "detect/regions.hpp"
#include "detect/settle_pieces.hpp"

namespace d2b {
namespace {

Regions cut(const Mask& cells, const ParcelGrid& parcels, const Grid<Label>& labels, Executor& threads) {
    const auto cols = static_cast<std::size_t>(labels.cols);
    return joined_regions(
        cells,
        [&](std::size_t i, std::size_t j) {
            return labels.values[i] == labels.values[j] &&
                   !parted(parcels.values[i], parcels.values[j], j == i + cols);
        },
        threads);
}

/// Calls use(run, row, begin, end) for all runs, with the index range of their cells.
template <typename Use>
void for_runs(const Regions& regions, const Use& use) {
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r)) {
            const std::size_t first = static_cast<std::size_t>(r) * static_cast<std::size_t>(regions.cols);
            use(run, r, first + static_cast<std::size_t>(run.begin),
                first + static_cast<std::size_t>(run.end));
        }
}

/// Returns the first cells of pieces that are not the largest piece of any object.
/// @param objects resulting objects, by cell
std::vector<FirstCell> pieces_gone(const Regions& pieces, const Grid<Label>& objects) {
    std::map<std::pair<Label, Label>, std::int64_t> shared;  // keyed by object and piece
    std::vector<FirstCell> first(pieces.cells.size(), {-1, -1});
    for_runs(pieces, [&](const RegionRun& run, std::int32_t row, std::size_t begin, std::size_t end) {
        if (first[run.label].row < 0)
            first[run.label] = {row, run.begin};
        for (std::size_t i = begin; i < end; ++i)
            ++shared[{objects.values[i], run.label}];
    });
    std::vector<bool> stays(pieces.cells.size(), false);
    for (auto of_object = shared.begin(); of_object != shared.end();) {
        auto most = of_object;
        auto next = of_object;
        for (; next != shared.end() && next->first.first == of_object->first.first; ++next)
            if (next->second > most->second)
                most = next;
        stays[most->first.second] = true;
        of_object = next;
    }
    std::vector<FirstCell> gone;
    for (Label piece = 1; piece < stays.size(); ++piece)
        if (!stays[piece])
            gone.push_back(first[piece]);
    return gone;
}

/// Assigns to each object the parcel with most of its cells; the lowest one wins ties.
void name_parcels(const ParcelGrid& parcels, Detection& detection) {
    std::map<std::pair<Label, std::int64_t>, std::int64_t> shared;
    auto last = shared.end();  // cached, because neighbours are mostly equal
    for (std::size_t i = 0; i < parcels.size(); ++i)
        if (const Label label = detection.labels.values[i]; label != 0) {
            const std::pair pair{label, parcels.values[i].parcel};
            if (last == shared.end() || last->first != pair)
                last = shared.try_emplace(pair, 0).first;
            ++last->second;
        }
    std::vector<std::int64_t> most(detection.objects.size(), 0);
    for (const auto& [pair, cells] : shared)
        if (cells > most[pair.first - 1]) {
            most[pair.first - 1] = cells;
            detection.objects[pair.first - 1].parcel = pair.second;
        }
}

}  // namespace

void cut_by_parcels(const Scene& scene, double width_m, std::int64_t least_cells, Detection& detection,
                    Executor& threads) {
    const ParcelGrid& parcels = *scene.parcels;
    const Mask cells = building_cells(detection);
    const Regions pieces = cut(cells, parcels, detection.labels, threads);
    if (pieces.count() > detection.buildings) {
        const Grid<Label> owners = settle_pieces(scene, piece_grid(pieces, threads), detection.labels,
                                                 pieces.count(), width_m, threads);
        const Regions regions = joined_regions(
            cells,
            [&](std::size_t i, std::size_t j) {
                return detection.labels.values[i] == detection.labels.values[j] &&
                       owners.values[i] == owners.values[j];
            },
            threads);
        PieceGraph graph(regions.count(), scene.cell);
        for (Label label = 1; label <= regions.count(); ++label) {
            graph.piece(label).cells = regions.cells[label];
            graph.piece(label).wide = true;
        }
        add_borders(piece_grid(regions, threads), detection.labels, graph);
        graph.merge_small(least_cells);
        write_pieces(regions, graph.numbered(), detection);
        detection.left_out.parts = pieces_gone(pieces, detection.labels);
    }
    name_parcels(parcels, detection);
}

}  // namespace d2b
