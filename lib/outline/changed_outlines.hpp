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

/// Outlines that replace those derived from traces, spooled at a few bytes per vertex.
class ChangedOutlines {
  public:
    struct Kept {
        SpoolEntry place;
        OutlineQuality quality;
    };
    explicit ChangedOutlines(std::unique_ptr<Spool> spool) : spool_(std::move(spool)) {}

    /// @param place a number chosen by the caller, unique per outline
    void put(std::size_t place, const FinePolygon& outline, const OutlineQuality& quality);
    /// @return nullptr if it has not been replaced
    [[nodiscard]] const Kept* find(std::size_t place) const;
    [[nodiscard]] FinePolygon outline(const Kept& kept) const;

    /// Ratio of the areas after and before.
    [[nodiscard]] static double grown(const FinePolygon& before, const FinePolygon& after);
    /// Largest distance in cells between corners of one outline and edges of the other.
    [[nodiscard]] static double apart_cells(const FinePolygon& before, const FinePolygon& after,
                                            const CellShape& shape);

  private:
    std::unique_ptr<Spool> spool_;
    std::map<std::size_t, Kept> kept_;
};

}  // namespace d2b
