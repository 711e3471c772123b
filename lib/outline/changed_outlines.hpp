#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <utility>

#include "core/lattice.hpp"
#include "dem2buildings/spool.hpp"
#include "outline/outline.hpp"
#include "outline/walls/wall_samples.hpp"

namespace d2b {

/// Outlines that are drawn otherwise than from their traces, in some bytes a vertex.
class ChangedOutlines {
  public:
    struct Kept {
        SpoolEntry place;
        OutlineQuality quality;
    };
    explicit ChangedOutlines(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// @param place a number of the caller's, one per outline
    void put(std::size_t place, const FinePolygon& outline, const OutlineQuality& quality);
    /// @return null where it has not changed
    [[nodiscard]] const Kept* find(std::size_t place) const;
    [[nodiscard]] FinePolygon outline(const Kept& kept) const;

    /// Area after, over area before.
    [[nodiscard]] static double grown(const FinePolygon& before, const FinePolygon& after);
    /// How far corners of either are from the other's edges, in cells.
    [[nodiscard]] static double apart_cells(const FinePolygon& before, const FinePolygon& after,
                                            const CellShape& shape);

  private:
    std::unique_ptr<Spool> spool_;
    std::map<std::size_t, Kept> kept_;
};

}  // namespace d2b
