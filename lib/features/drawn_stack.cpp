#include "features/drawn_stack.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "core/byte_record.hpp"

namespace d2b {
namespace {

constexpr double no_tier = std::numeric_limits<double>::quiet_NaN();

/// The tiers of a band, which only buildings' cells have.
class Tiers {
  public:
    Tiers(const BandShape& shape, std::int32_t first_col)
        : shape_(shape), first_col_(first_col), tiers_(shape.size()) {}

    /// Calls use(first, last) with the tiers of each run of an entry that lies in the band.
    template <typename Use>
    void for_runs(const Spool& spool, const SpoolEntry& entry, const Use& use) {
        ByteReader reader(spool, entry);
        const auto tier = reader.take<double>();
        for (std::size_t i = 0; i < (entry.size - sizeof(double)) / sizeof(RowSpan); ++i) {
            const auto run = reader.take<RowSpan>();
            const std::int32_t begin = std::max(run.begin - first_col_, 0);
            const std::int32_t end = std::min(run.end - first_col_, shape_.cols);
            if (run.row >= shape_.first_row && run.row < shape_.first_row + shape_.rows && begin < end)
                use(index(run.row, begin), index(run.row, end), tier);
        }
    }
    [[nodiscard]] double& at(std::size_t i) { return tiers_[i]; }
    void fill(std::size_t begin, std::size_t end, double tier) {
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

}  // namespace

double StackError::rms(const FixedPoint& fixed) const {
    return n == 0 ? 0
                  : std::sqrt(fixed.squares(static_cast<double>(coarse_squares)) / static_cast<double>(n));
}

DrawnStack::DrawnStack(std::unique_ptr<Spool> spool, const Window& window)
    : spool_(std::move(spool)), window_(window), slabs_(window.row, window.rows) {}

void DrawnStack::add_building(const std::vector<RowSpan>& cells) {
    add(cells, no_tier, &Slab::buildings);
}

void DrawnStack::add_contour(const std::vector<RowSpan>& cells, double tier) {
    if (!std::isnan(tier))
        add(cells, tier, &Slab::contours);
}

void DrawnStack::add(const std::vector<RowSpan>& cells, double tier, std::vector<SpoolEntry> Slab::*entries) {
    std::map<std::size_t, ByteWriter> parts;  // by slab
    for (const RowSpan& cell : cells) {
        const std::int32_t row = cell.row - window_.row;
        // Columns as a band has them.
        const RowSpan run{cell.row, std::max(cell.begin - window_.col, 0),
                          std::min(cell.end - window_.col, window_.cols)};
        if (row < 0 || row >= window_.rows || run.begin >= run.end)
            continue;
        ByteWriter& part = parts[slabs_.index(cell.row)];
        if (part.bytes().empty())
            part.put(tier);
        part.put(run);
    }
    for (const auto& [slab, part] : parts)
        (slabs_[slab].*entries).push_back(append(*spool_, part));
}

StackError DrawnStack::error(const ElevationBand& band, std::int32_t first_col,
                             const FixedPoint& fixed) const {
    StackError error;
    Tiers tiers(band.shape, first_col);
    const auto for_runs = [&](const std::vector<SpoolEntry> Slab::*entries, const auto& use) {
        slabs_.for_band(band.shape, [&](const Slab& slab) {
            for (const SpoolEntry& entry : slab.*entries)
                tiers.for_runs(*spool_, entry, use);
        });
    };
    const auto paint = [&](std::size_t begin, std::size_t end, double tier) { tiers.fill(begin, end, tier); };
    for_runs(&Slab::buildings, paint);
    for_runs(&Slab::contours, paint);
    for_runs(&Slab::buildings, [&](std::size_t begin, std::size_t end, double) {
        for (std::size_t i = begin; i < end; ++i) {
            const double distance = tiers.at(i) - band.elevations[i];
            tiers.at(i) = no_tier;  // each cell once
            if (!std::isnan(distance))
                error.add(distance, fixed);
        }
    });
    return error;
}

}  // namespace d2b
