#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace d2b {

/// Decision of an editor that a run obeys.
enum class CorrectionKind : std::uint8_t {
    building,     ///< a building stands here
    no_building,  ///< the object here is not a building
    cut,          ///< a line that divides a building
};
/// Words of a dataset, by kind.
inline constexpr std::array<std::string_view, 3> correction_names{"building", "no building", "cut"};

/// Run of cells in a row of the whole DEM.
struct CellRun {
    std::int32_t row = 0;
    std::int32_t begin = 0;  ///< columns [begin, end)
    std::int32_t end = 0;
};

/// Pair of neighbouring cells that a line separates.
struct CellCut {
    std::int32_t row = 0;
    std::int32_t col = 0;
    bool below = false;  ///< the other cell is below this one, otherwise to its right
};

/// Correction on the grid of a DEM, as far as it lies in the DEM's window.
struct Correction {
    CorrectionKind kind = CorrectionKind::building;
    bool is_point = false;       ///< its cell names an object, otherwise the cells are those of a polygon
    std::vector<CellRun> cells;  ///< row by row; empty for cuts
    std::vector<CellCut> cuts;   ///< of CorrectionKind::cut
    std::string name;            ///< in messages: "feature 7"

    [[nodiscard]] bool is_outside() const { return cells.empty() && cuts.empty(); }
};

/// Source of corrections.
class CorrectionSource {
  public:
    CorrectionSource() = default;
    CorrectionSource(const CorrectionSource&) = delete;
    CorrectionSource& operator=(const CorrectionSource&) = delete;
    virtual ~CorrectionSource() = default;

    /// Returns the usable corrections, in the order of the source. Valid as long as the source.
    [[nodiscard]] virtual const std::vector<Correction>& corrections() const = 0;
    /// Returns the number of features that are no corrections, of which warnings tell.
    [[nodiscard]] virtual std::int64_t unusable() const { return 0; }
    /// Same as DemSource::take_warnings().
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
};

}  // namespace d2b
