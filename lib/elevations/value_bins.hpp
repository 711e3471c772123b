#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/byte_record.hpp"
#include "core/elevation_limits.hpp"
#include "core/value_counts.hpp"

namespace d2b {

/// Finds exact values that are shared by many cells and far from all others, which may be undeclared NoData.
/// Such a value is alone in its bin, so the lowest and highest value of each bin suffice: a mergeable
/// reduction, exact for any bands and threads.
class ValueBins {
  public:
    /// @param limits limits of all values; if they are more than 100 km apart, nothing is found
    /// @param metres metres per vertical unit
    ValueBins(const ElevationLimits& limits, double metres);

    /// Adds a stretch of cells, NaN or within the limits.
    /// @param lowest, highest, cells range and number of those that are not NaN
    /// @pre cells > 0
    template <typename Values>
    void add(const Values& values, double lowest, double highest, std::int64_t cells) {
        if (bins_.empty())
            return;
        if (lowest == highest) {
            add(lowest, cells);
        } else if (highest - lowest <= apart_) {
            // No value here is far from all others, and values between the extremes add no information.
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
    /// Restores bins saved with the same limits and unit.
    void load(ByteReader& reader);

    /// Returns the values shared by at least ten cells and a thousandth of all, and more than 50 m from any
    /// other, ascending. A value that is the only one does not count.
    /// @param cells number of valid cells
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
