#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/byte_record.hpp"
#include "core/elevation_limits.hpp"
#include "core/value_counts.hpp"

namespace d2b {

/// Finds exact values that many cells share, far from all others: what may stand for no data without being
/// declared. Such a value has its bin for itself, and all that it takes to see so is each bin's lowest and
/// highest value: a mergeable reduction, exact whatever the bands and threads.
class ValueBins {
  public:
    /// @param limits of all values; where they are more than 100 km apart nothing is found
    /// @param metres in a vertical unit
    ValueBins(const ElevationLimits& limits, double metres);

    /// Cells of a stretch, which are NaN or within the limits. @param lowest, highest, cells of those that
    /// are not NaN
    /// @pre cells > 0
    template <typename Values>
    void add(const Values& values, double lowest, double highest, std::int64_t cells) {
        if (bins_.empty())
            return;
        if (lowest == highest) {
            add(lowest, cells);
        } else if (highest - lowest <= apart_) {
            // None of these is far from all others, and those between the two tell nothing more.
            add(lowest, 1);
            add(highest, 1);
        } else {
            for (const double value : values)
                if (value == value)
                    add(value, 1);
        }
    }
    void merge(const ValueBins& other);
    void save(ByteWriter& writer) const { writer.put_list(bins_); }
    /// Takes what bins of the same limits and unit saved.
    void load(ByteReader& reader);

    /// The values that at least ten cells and a thousandth of all share, more than 50 m from any other,
    /// ascending. Not the only value of all.
    /// @param cells that are valid
    [[nodiscard]] std::vector<SharedValue> shared(std::int64_t cells) const;

    static constexpr double apart_m = 50;

  private:
    struct Bin {
        std::int64_t cells = 0;
        double lowest = std::numeric_limits<double>::infinity();
        double highest = -std::numeric_limits<double>::infinity();
    };
    void add(double value, std::int64_t cells);

    double lowest_;
    double apart_;
    double bins_a_unit_;
    std::vector<Bin> bins_;
};

}  // namespace d2b
