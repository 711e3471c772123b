#include "detect/divide_buildings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "core/band.hpp"
#include "detect/building_pieces.hpp"
#include "raster/morphology.hpp"

namespace d2b::detect {

/// Assigns the final piece to each cell of a building. Parcels and walls never agree exactly, and the raster
/// blurs both. Therefore cells are unassigned that an opening of their piece by half of the width removes
/// and, within this width of a cut, cells that an opening removes from step-free parts of a piece, because a
/// cut there runs next to a wall. An unassigned cell then gets the piece of most of its assigned neighbours
/// that are not separated by a step (its own piece wins ties, then the first), so that a cut moves to the
/// wall next to it. Cells enclosed by steps get their own piece or, if it is not adjacent, that of most
/// neighbours. Buildings without any assigned cell become their first piece.
/// Halo: buildings. Time O(n) for n cells, except for very long and narrow pieces.
/// @param pieces pieces of buildings, numbered from 1 to count, each within one building
/// @param buildings labels of buildings
[[nodiscard]] Grid<Label> assign_cells(const Scene& scene, const Grid<Label>& pieces,
                                       const Grid<Label>& buildings, Label count, double width_m,
                                       Executor& threads);

namespace {

class CellAssigner {
  public:
    CellAssigner(const Scene& scene, const Grid<Label>& pieces, const Grid<Label>& buildings, double width_m)
        : scene_(scene),
          pieces_(pieces),
          buildings_(buildings),
          width_(width_m),
          element_(disk_element(width_m / 2, scene.cell)),
          step_(roof_step(scene)),
          owners_(pieces) {}

    void mark_cut(Label count) {
        std::vector<Label> building_of(count + std::size_t{1}, 0);
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            building_of[pieces_.values[i]] = buildings_.values[i];
        first_piece_.assign(std::size_t{1} + *std::max_element(building_of.begin() + 1, building_of.end()),
                            0);
        std::vector<bool> is_cut(first_piece_.size(), false);
        for (Label piece = 1; piece <= count; ++piece) {
            Label& first = first_piece_[building_of[piece]];
            is_cut[building_of[piece]] = first != 0;
            first = first == 0 ? piece : first;
        }
        in_cut_building_ = Mask(pieces_.rows, pieces_.cols);
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            in_cut_building_.values[i] = pieces_.values[i] != 0 && is_cut[buildings_.values[i]] ? 1 : 0;
    }
    /// Unassigns the cells that an opening removes.
    /// @param pieces pieces, or parts of them
    /// @param where cells that may be unassigned
    void unassign(const Grid<Label>& pieces, const Mask& where) {
        Mask kept = open_pieces(pieces);
        std::vector<std::size_t> off;
        for (std::size_t i = 0; i < pieces.size(); ++i)
            if (in_cut_building_.values[i] != 0 && kept.values[i] == 0 && where.values[i] != 0)
                off.push_back(i);
        // Restores the corners that an opening rounds off.
        const int corner = static_cast<int>(std::ceil(width_ / 4 / scene_.side())) + 1;
        for (int round = 0; round < corner; ++round)
            grow(pieces, off, kept);
        for (const std::size_t i : off)
            if (kept.values[i] == 0)
                owners_.values[i] = 0;
    }
    [[nodiscard]] Mask near_cuts(Executor& threads) const {
        Mask whole(pieces_.rows, pieces_.cols, 1);
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            if (in_cut_building_.values[i] != 0)
                for_neighbours(i, [&](std::size_t j) {
                    if (pieces_.values[j] != pieces_.values[i] &&
                        buildings_.values[j] == buildings_.values[i])
                        whole.values[i] = 0;
                });
        Mask near = erode(whole, width_, scene_.cell, threads);
        for (std::uint8_t& value : near.values)
            value ^= 1;
        return near;
    }
    [[nodiscard]] Grid<Label> stepless(Executor& threads) const {
        return piece_grid(joined_regions(
                              in_cut_building_,
                              [&](std::size_t i, std::size_t j) {
                                  return pieces_.values[i] == pieces_.values[j] && !is_step(i, j);
                              },
                              threads),
                          threads);
    }
    [[nodiscard]] const Mask& cut_building_cells() const { return in_cut_building_; }
    void assign_all() {
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            if (in_cut_building_.values[i] != 0 && owners_.values[i] == 0)
                unassigned_.push_back(i);
        flood(false);
        flood(true);
        for (const std::size_t i : unassigned_)
            owners_.values[i] = first_piece_[buildings_.values[i]];
    }
    [[nodiscard]] Grid<Label> take() { return std::move(owners_); }

  private:
    /// Calls use(index) for the 4-neighbours of a cell.
    template <typename Use>
    void for_neighbours(std::size_t i, const Use& use) const {
        const auto cols = static_cast<std::size_t>(pieces_.cols);
        const std::size_t col = i % cols;
        if (i >= cols)
            use(i - cols);
        if (col > 0)
            use(i - 1);
        if (col + 1 < cols)
            use(i + 1);
        if (i + cols < pieces_.size())
            use(i + cols);
    }
    [[nodiscard]] bool is_step(std::size_t i, std::size_t j) const {
        return !(std::abs(scene_.surface.values[i] - scene_.surface.values[j]) <= step_);
    }
    /// Opening of pieces, or of parts of them.
    [[nodiscard]] Mask open_pieces(const Grid<Label>& pieces) const {
        Mask kept(pieces.rows, pieces.cols);
        const auto keep = [&](const ElementRow& part, std::int32_t r, std::int32_t c) {
            const std::int32_t y = r + part.down;
            const std::int32_t left = std::max(c + part.left, 0);
            if (y >= 0 && y < pieces.rows)
                std::fill_n(&kept.at(y, left), std::min(c + part.right + 1, pieces.cols) - left,
                            std::uint8_t{1});
        };
        for (std::int32_t r = 0; r < pieces.rows; ++r)
            for (std::int32_t c = 0; c < pieces.cols; ++c)
                if (in_cut_building_.at(r, c) != 0 && fits(pieces, element_, r, c))
                    for (const ElementRow& part : element_)
                        keep(part, r, c);
        return kept;
    }
    /// One step of dilation within pieces, restricted to the given cells.
    void grow(const Grid<Label>& pieces, const std::vector<std::size_t>& cells, Mask& kept) const {
        std::vector<std::size_t> back;
        for (const std::size_t i : cells)
            if (kept.values[i] == 0)
                for_neighbours(i, [&](std::size_t j) {
                    if (kept.values[j] != 0 && pieces.values[j] == pieces.values[i])
                        back.push_back(i);
                });
        for (const std::size_t i : back)
            kept.values[i] = 1;
    }
    /// Returns the owner for an unassigned cell; 0 if there is none yet.
    [[nodiscard]] Label choice(std::size_t cell, bool across_steps) const {
        std::array<std::pair<int, Label>, 4> votes{};
        for_neighbours(cell, [&](std::size_t j) {
            const Label owner = owners_.values[j];
            if (owner == 0 || buildings_.values[j] != buildings_.values[cell] ||
                (!across_steps && is_step(cell, j)))
                return;
            for (auto& [count, label] : votes)
                if (count == 0 || label == owner) {
                    ++count;
                    label = owner;
                    break;
                }
        });
        const Label own = pieces_.values[cell];
        const auto better = [&](const std::pair<int, Label>& a, const std::pair<int, Label>& b) {
            if (across_steps && (a.second == own) != (b.second == own) && a.first > 0 && b.first > 0)
                return a.second == own;
            if (a.first != b.first)
                return a.first > b.first;
            if ((a.second == own) != (b.second == own))
                return a.second == own;
            return a.second < b.second;
        };
        return std::ranges::min(votes, better).second;
    }
    /// Flood fill in rounds. Each round reads only the previous one, so the order of cells does not matter.
    void flood(bool across_steps) {
        std::vector<std::pair<std::size_t, Label>> found;
        do {
            found.clear();
            for (const std::size_t i : unassigned_)
                if (const Label owner = choice(i, across_steps); owner != 0)
                    found.emplace_back(i, owner);
            for (const auto& [i, owner] : found)
                owners_.values[i] = owner;
            std::erase_if(unassigned_, [&](std::size_t i) { return owners_.values[i] != 0; });
        } while (!found.empty());
    }

    const Scene& scene_;
    const Grid<Label>& pieces_;
    const Grid<Label>& buildings_;
    double width_;
    Element element_;
    float step_;
    Grid<Label> owners_;                   // 0: unassigned, or not a building
    Mask in_cut_building_;                 // cells of buildings with more than one piece
    std::vector<Label> first_piece_;       // by building
    std::vector<std::size_t> unassigned_;  // unassigned cells
};

Regions cut(const Mask& cells, const ParcelGrid& parcels, const Grid<Label>& labels, Executor& threads) {
    const auto cols = static_cast<std::size_t>(labels.cols);
    return joined_regions(
        cells,
        [&](std::size_t i, std::size_t j) {
            return labels.values[i] == labels.values[j] &&
                   !separated_by_parcel(parcels.values[i], parcels.values[j], j == i + cols);
        },
        threads);
}

/// Returns the first cells of pieces that are not the largest piece of any object.
/// @param objects resulting objects, by cell
std::vector<FirstCell> pieces_gone(const Regions& pieces, const Grid<Label>& objects) {
    std::map<std::pair<Label, Label>, std::int64_t> shared;  // keyed by object and piece
    std::vector<FirstCell> first(pieces.cells.size());
    for_first_runs(pieces, [&](std::int32_t r, const RegionRun& run) { first[run.label] = {r, run.begin}; });
    for_runs(pieces, [&](std::int32_t r, const RegionRun& run) {
        for (std::int32_t c = run.begin; c < run.end; ++c)
            ++shared[{objects.at(r, c), run.label}];
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

void add_cells(const Scene& scene, const Regions& regions, PieceAdjacencyGraph& graph) {
    for_runs(regions, [&](std::int32_t r, const RegionRun& run) {
        PieceAdjacencyGraph::Piece& piece = graph.piece(run.label);
        piece.cells += run.end - run.begin;
        for (std::int32_t c = run.begin; c < run.end; ++c)
            if (const float z = scene.surface.at(r, c); !std::isnan(z)) {
                ++piece.heights;
                piece.height_sum += static_cast<double>(z);
            }
    });
}

void mark_wide(const Grid<Label>& pieces, const Regions& regions, const Element& element,
               PieceAdjacencyGraph& graph) {
    for_runs(regions, [&](std::int32_t r, const RegionRun& run) {
        bool& wide = graph.piece(run.label).wide;
        for (std::int32_t c = run.begin; c < run.end && !wide; ++c)
            wide = fits(pieces, element, r, c);
    });
}

}  // namespace

Grid<Label> assign_cells(const Scene& scene, const Grid<Label>& pieces, const Grid<Label>& buildings,
                         Label count, double width_m, Executor& threads) {
    CellAssigner assigner(scene, pieces, buildings, width_m);
    if (!(width_m > 0))
        return assigner.take();
    assigner.mark_cut(count);
    assigner.unassign(pieces, assigner.cut_building_cells());
    assigner.unassign(assigner.stepless(threads), assigner.near_cuts(threads));
    assigner.assign_all();
    return assigner.take();
}

Regions divide_along(const Scene& scene, const ParcelGrid& boundaries, double width_m, std::int64_t min_cells,
                     Detection& detection, Executor& threads) {
    const Mask cells = building_cells(detection);
    Regions pieces = cut(cells, boundaries, detection.labels, threads);
    if (pieces.count() > detection.buildings) {
        const Grid<Label> owners = assign_cells(scene, piece_grid(pieces, threads), detection.labels,
                                                pieces.count(), width_m, threads);
        const Regions regions = joined_regions(
            cells,
            [&](std::size_t i, std::size_t j) {
                return detection.labels.values[i] == detection.labels.values[j] &&
                       owners.values[i] == owners.values[j];
            },
            threads);
        PieceAdjacencyGraph graph(regions.count(), scene.cell);
        for (Label label = 1; label <= regions.count(); ++label) {
            graph.piece(label).cells = regions.cells[label];
            graph.piece(label).wide = true;
        }
        add_borders(piece_grid(regions, threads), detection.labels, graph);
        graph.merge_small(min_cells);
        write_pieces(regions, graph.numbered(), detection);
    }
    return pieces;
}

void cut_by_parcels(const Scene& scene, double width_m, std::int64_t min_cells, Detection& detection,
                    Executor& threads) {
    const ParcelGrid& parcels = *scene.parcels;
    const Label whole = detection.buildings;
    const Regions pieces = divide_along(scene, parcels, width_m, min_cells, detection, threads);
    if (pieces.count() > whole)
        detection.rejected.parts = pieces_gone(pieces, detection.labels);
    name_parcels(parcels, detection);
}

void split_buildings(const Scene& scene, double split_height, std::int64_t min_cells, Detection& detection,
                     Executor& threads) {
    const Regions regions = stepless_pieces(scene, static_cast<float>(split_height), detection, threads);
    if (regions.count() == 0)
        return;
    PieceAdjacencyGraph graph(regions.count(), scene.cell);
    add_cells(scene, regions, graph);
    {
        const Grid<Label> pieces = piece_grid(regions, threads);
        add_borders(pieces, detection.labels, graph);
        mark_wide(pieces, regions, disk_element(narrow_radius_m, scene.cell), graph);
    }
    graph.merge_small(min_cells);
    write_pieces(regions, graph.numbered(), detection);
}

}  // namespace d2b::detect
