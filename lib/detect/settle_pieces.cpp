#include "detect/settle_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "detect/morphology.hpp"
#include "detect/piece_cells.hpp"
#include "detect/roof_step.hpp"

namespace d2b {
namespace {

class Settler {
  public:
    Settler(const Scene& scene, const Grid<Label>& pieces, const Grid<Label>& buildings, double width_m)
        : scene_(scene),
          pieces_(pieces),
          buildings_(buildings),
          width_(width_m),
          element_(disk_element(width_m / 2, scene.cell)),
          step_(roof_step(scene)),
          owners_(pieces) {}

    void mark_cut(Label count);
    void loosen(const Grid<Label>& pieces, const Mask& where);
    [[nodiscard]] Mask near_cuts(Executor& threads) const;
    [[nodiscard]] Grid<Label> stepless(Executor& threads) const;
    [[nodiscard]] const Mask& of_cut_buildings() const { return of_cut_; }
    void settle();
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
    [[nodiscard]] Mask opened(const Grid<Label>& pieces) const;
    void grow(const Grid<Label>& pieces, const std::vector<std::size_t>& cells, Mask& kept) const;
    [[nodiscard]] Label choice(std::size_t cell, bool across_steps) const;
    void flood(bool across_steps);

    const Scene& scene_;
    const Grid<Label>& pieces_;
    const Grid<Label>& buildings_;
    double width_;
    Element element_;
    float step_;
    Grid<Label> owners_;              // 0: unassigned, or not a building
    Mask of_cut_;                     // cells of buildings with more than one piece
    std::vector<Label> first_piece_;  // by building
    std::vector<std::size_t> loose_;  // unassigned cells
};

void Settler::mark_cut(Label count) {
    std::vector<Label> building_of(count + std::size_t{1}, 0);
    for (std::size_t i = 0; i < pieces_.size(); ++i)
        building_of[pieces_.values[i]] = buildings_.values[i];
    first_piece_.assign(std::size_t{1} + *std::max_element(building_of.begin() + 1, building_of.end()), 0);
    std::vector<bool> is_cut(first_piece_.size(), false);
    for (Label piece = 1; piece <= count; ++piece) {
        Label& first = first_piece_[building_of[piece]];
        is_cut[building_of[piece]] = first != 0;
        first = first == 0 ? piece : first;
    }
    of_cut_ = Mask(pieces_.rows, pieces_.cols);
    for (std::size_t i = 0; i < pieces_.size(); ++i)
        of_cut_.values[i] = pieces_.values[i] != 0 && is_cut[buildings_.values[i]] ? 1 : 0;
}

/// Opening of pieces, or of parts of them.
Mask Settler::opened(const Grid<Label>& pieces) const {
    Mask kept(pieces.rows, pieces.cols);
    const auto keep = [&](const ElementRow& part, std::int32_t r, std::int32_t c) {
        const std::int32_t y = r + part.down;
        const std::int32_t left = std::max(c + part.left, 0);
        if (y >= 0 && y < pieces.rows)
            std::fill_n(&kept.at(y, left), std::min(c + part.right + 1, pieces.cols) - left, std::uint8_t{1});
    };
    for (std::int32_t r = 0; r < pieces.rows; ++r)
        for (std::int32_t c = 0; c < pieces.cols; ++c)
            if (of_cut_.at(r, c) != 0 && fits(pieces, element_, r, c))
                for (const ElementRow& part : element_)
                    keep(part, r, c);
    return kept;
}

/// One step of dilation within pieces, restricted to the given cells.
void Settler::grow(const Grid<Label>& pieces, const std::vector<std::size_t>& cells, Mask& kept) const {
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

/// Unassigns the cells that an opening removes.
/// @param pieces pieces, or parts of them
/// @param where cells that may be unassigned
void Settler::loosen(const Grid<Label>& pieces, const Mask& where) {
    Mask kept = opened(pieces);
    std::vector<std::size_t> off;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (of_cut_.values[i] != 0 && kept.values[i] == 0 && where.values[i] != 0)
            off.push_back(i);
    // Restores the corners that an opening rounds off.
    const int corner = static_cast<int>(std::ceil(width_ / 4 / scene_.side())) + 1;
    for (int round = 0; round < corner; ++round)
        grow(pieces, off, kept);
    for (const std::size_t i : off)
        if (kept.values[i] == 0)
            owners_.values[i] = 0;
}

Mask Settler::near_cuts(Executor& threads) const {
    Mask whole(pieces_.rows, pieces_.cols, 1);
    for (std::size_t i = 0; i < pieces_.size(); ++i)
        if (of_cut_.values[i] != 0)
            for_neighbours(i, [&](std::size_t j) {
                if (pieces_.values[j] != pieces_.values[i] && buildings_.values[j] == buildings_.values[i])
                    whole.values[i] = 0;
            });
    Mask near = eroded(whole, width_, scene_.cell, threads);
    for (std::uint8_t& value : near.values)
        value ^= 1;
    return near;
}

Grid<Label> Settler::stepless(Executor& threads) const {
    return piece_grid(joined_regions(
                          of_cut_,
                          [&](std::size_t i, std::size_t j) {
                              return pieces_.values[i] == pieces_.values[j] && !is_step(i, j);
                          },
                          threads),
                      threads);
}

/// Returns the owner for an unassigned cell; 0 if there is none yet.
Label Settler::choice(std::size_t cell, bool across_steps) const {
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
void Settler::flood(bool across_steps) {
    std::vector<std::pair<std::size_t, Label>> found;
    do {
        found.clear();
        for (const std::size_t i : loose_)
            if (const Label owner = choice(i, across_steps); owner != 0)
                found.emplace_back(i, owner);
        for (const auto& [i, owner] : found)
            owners_.values[i] = owner;
        std::erase_if(loose_, [&](std::size_t i) { return owners_.values[i] != 0; });
    } while (!found.empty());
}

void Settler::settle() {
    for (std::size_t i = 0; i < pieces_.size(); ++i)
        if (of_cut_.values[i] != 0 && owners_.values[i] == 0)
            loose_.push_back(i);
    flood(false);
    flood(true);
    for (const std::size_t i : loose_)
        owners_.values[i] = first_piece_[buildings_.values[i]];
}

}  // namespace

Grid<Label> settle_pieces(const Scene& scene, const Grid<Label>& pieces, const Grid<Label>& buildings,
                          Label count, double width_m, Executor& threads) {
    Settler settler(scene, pieces, buildings, width_m);
    if (!(width_m > 0))
        return settler.take();
    settler.mark_cut(count);
    settler.loosen(pieces, settler.of_cut_buildings());
    settler.loosen(settler.stepless(threads), settler.near_cuts(threads));
    settler.settle();
    return settler.take();
}

}  // namespace d2b
