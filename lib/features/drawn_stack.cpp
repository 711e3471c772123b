#include "features/drawn_stack.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "core/byte_stream.hpp"

namespace d2b::features {
namespace {

constexpr double no_tier = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// Tier of each cell of a slab of rows. Only the cells of buildings are initialised.
class DrawnStack::SlabTiers {
  public:
    explicit SlabTiers(std::int32_t first_col) : first_col_(first_col) {}

    /// Switches to other rows. Cells are uninitialised until cleared.
    void begin(const BandShape& rows) {
        shape_ = rows;
        tiers_.resize(rows.size());
    }
    /// Calls use(first, last, tier) for each run of an entry, clipped to the rows.
    template <typename Use>
    void for_runs(const Spool& spool, const SpoolEntry& entry, const Use& use) const {
        ByteReader reader(spool, entry);
        const auto tier = reader.take<StackTier>();
        for (const RowSpan& run : reader.take_list<RowSpan>()) {
            const std::int32_t begin = std::max(run.begin - first_col_, 0);
            const std::int32_t end = std::min(run.end - first_col_, shape_.cols);
            if (run.row >= shape_.first_row && run.row < shape_.first_row + shape_.rows && begin < end)
                use(index(run.row, begin), index(run.row, end), tier);
        }
    }
    void clear(std::size_t begin, std::size_t end) {
        std::fill(tiers_.begin() + static_cast<std::ptrdiff_t>(begin),
                  tiers_.begin() + static_cast<std::ptrdiff_t>(end), no_tier);
    }
    [[nodiscard]] double& at(std::size_t i) { return tiers_[i]; }
    /// Does nothing if the tier is NaN.
    void fill(std::size_t begin, std::size_t end, double tier) {
        if (std::isnan(tier))
            return;
        std::fill(tiers_.begin() + static_cast<std::ptrdiff_t>(begin),
                  tiers_.begin() + static_cast<std::ptrdiff_t>(end), tier);
    }

  private:
    [[nodiscard]] std::size_t index(std::int32_t row, std::int32_t col) const {
        return static_cast<std::size_t>(row - shape_.first_row) * static_cast<std::size_t>(shape_.cols) +
               static_cast<std::size_t>(col);
    }
    BandShape shape_;
    std::int32_t first_col_;
    std::vector<double> tiers_;
};

double StackError::rms(const FixedPoint& fixed) const {
    return n == 0 ? 0
                  : std::sqrt(fixed.squares(static_cast<double>(coarse_squares)) / static_cast<double>(n));
}

DrawnStack::DrawnStack(std::unique_ptr<Spool> spool, const Window& window)
    : spool_(std::move(spool)), window_(window), slabs_(window.row, window.rows) {}

void DrawnStack::add_building(const std::vector<RowSpan>& cells) {
    add(cells, {no_tier, no_tier, 0}, &Slab::buildings);
}

void DrawnStack::add_contour(const std::vector<RowSpan>& cells, const StackTier& tier) {
    add(cells, tier, &Slab::contours);
}

void DrawnStack::add(const std::vector<RowSpan>& cells, const StackTier& tier,
                     std::vector<SpoolEntry> Slab::*entries) {
    std::map<std::size_t, std::vector<RowSpan>> parts;  // by slab
    for (const RowSpan& cell : cells) {
        const std::int32_t row = cell.row - window_.row;
        // columns relative to the window, as in bands
        const RowSpan run{cell.row, std::max(cell.begin - window_.col, 0),
                          std::min(cell.end - window_.col, window_.cols)};
        if (row >= 0 && row < window_.rows && run.begin < run.end)
            parts[slabs_.index(cell.row)].push_back(run);
    }
    for (const auto& [slab, runs] : parts) {
        ByteWriter part;
        part.put(tier);
        part.put_list(runs);
        (slabs_[slab].*entries).push_back(append(*spool_, part));
    }
}

template <typename Work>
void DrawnStack::for_slabs(const ElevationBand& band, const Work& work) const {
    const std::int32_t end = band.shape.first_row + band.shape.rows;
    std::size_t first = 0;
    for (std::int32_t row = band.shape.first_row; row < end;) {
        const std::size_t slab = slabs_.index(row);
        BandShape rows{row, 0, band.shape.cols};
        while (row < end && slabs_.index(row) == slab)
            ++row;
        rows.rows = row - rows.first_row;
        work(slabs_[slab], rows, std::span(band.elevations).subspan(first, rows.size()));
        first += rows.size();
    }
}

template <typename Use>
void DrawnStack::for_runs(const SlabTiers& tiers, const std::vector<SpoolEntry>& entries,
                          const Use& use) const {
    for (const SpoolEntry& entry : entries)
        tiers.for_runs(*spool_, entry, use);
}

StackError DrawnStack::measured(SlabTiers& tiers, const Slab& slab, std::span<const double> elevations,
                                const FixedPoint& fixed) const {
    StackError error;
    for_runs(tiers, slab.buildings, [&](std::size_t begin, std::size_t end, const StackTier&) {
        for (std::size_t i = begin; i < end; ++i) {
            const double distance = tiers.at(i) - elevations[i];
            tiers.at(i) = no_tier;  // counts each cell once
            if (!std::isnan(distance))
                error.add(distance, fixed);
        }
    });
    return error;
}

void DrawnStack::begin_buildings(SlabTiers& tiers, const Slab& slab) const {
    for_runs(tiers, slab.buildings,
             [&](std::size_t begin, std::size_t end, const StackTier&) { tiers.clear(begin, end); });
}

StackError DrawnStack::error(const ElevationBand& band, const FixedPoint& fixed,
                             std::int32_t first_col) const {
    StackError error;
    SlabTiers tiers(first_col);
    for_slabs(band, [&](const Slab& slab, const BandShape& rows, std::span<const double> elevations) {
        tiers.begin(rows);
        begin_buildings(tiers, slab);
        for_runs(tiers, slab.contours, [&](std::size_t begin, std::size_t end, const StackTier& tier) {
            tiers.fill(begin, end, tier.own);
        });
        error.merge(measured(tiers, slab, elevations, fixed));
    });
    return error;
}

std::vector<StackError> DrawnStack::errors_by_level(const ElevationBand& band, const FixedPoint& fixed,
                                                    std::int32_t levels) const {
    std::vector<StackError> errors(static_cast<std::size_t>(levels));
    SlabTiers below(0);
    for_slabs(band, [&](const Slab& slab, const BandShape& rows, std::span<const double> elevations) {
        below.begin(rows);
        begin_buildings(below, slab);
        for (std::int32_t level = 1; level <= levels; ++level) {
            SlabTiers cut = below;
            for_runs(cut, slab.contours, [&](std::size_t begin, std::size_t end, const StackTier& tier) {
                if (tier.level != level)
                    return;
                cut.fill(begin, end, tier.whole);
                below.fill(begin, end, tier.own);
            });
            errors[static_cast<std::size_t>(level - 1)].merge(measured(cut, slab, elevations, fixed));
        }
    });
    return errors;
}

}  // namespace d2b::features
