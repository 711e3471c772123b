#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/georeference.hpp"
#include "core/options.hpp"
#include "trace/contour.hpp"

namespace d2b {

/// What became of an outline on its way from the trace to the file.
enum class OutlineStatus { traced, simplified, kept_traced, repaired };

/// How outlines are drawn from contours.
enum class Drawing {
    traced,     ///< corner by corner: exact where rows and columns run along the axes and nothing moves them
    noded,      ///< with every corner that another outline has on it, so that what is shared stays shared
    simplified  ///< from shared arcs, straightened
};

/// Draws outlines of contours on the lattice, one at a time.
class Outliner {
  public:
    /// @param contours all that are kept, sorted by key; they stay the caller's and must outlive this
    Outliner(const std::vector<Contour>& contours, Drawing drawing, const OutlineOptions& options,
             const Georeference& georeference);
    Outliner(Outliner&&) noexcept;
    Outliner& operator=(Outliner&&) noexcept;
    ~Outliner();

    [[nodiscard]] OutlineStatus status() const;
    [[nodiscard]] LatticePolygon outline(std::size_t contour) const;
    /// The outline without simplification: the way back where a polygon would be invalid.
    [[nodiscard]] LatticePolygon traced(std::size_t contour) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// What the options and the grid call for: nothing is noded that cannot come apart.
[[nodiscard]] Drawing choose_drawing(const OutlineOptions& options, const Georeference& georeference);

}  // namespace d2b
