#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/byte_stream.hpp"

namespace d2b {

/// Valid range of elevations in any unit. Values outside it are not elevations. Holds every finite value by
/// default.
struct ElevationLimits {
    double lowest = -std::numeric_limits<double>::max();
    double highest = std::numeric_limits<double>::max();

    /// Returns true if the elevation is in the range; false for NaN.
    [[nodiscard]] bool hold(double elevation) const { return elevation >= lowest && elevation <= highest; }
    /// Converts to another unit. @param factor new units per old unit
    [[nodiscard]] ElevationLimits times(double factor) const { return {lowest * factor, highest * factor}; }
};

/// Metres. The lowest shore is that of the Dead Sea at -430 m, the highest summit 8,849 m; opencast mines may
/// be some 300 m deep.
inline constexpr ElevationLimits land_elevations{-500, 9000};

/// Exact value and the number of cells that have it.
struct SharedValue {
    double value = 0;
    std::int64_t cells = 0;
};

/// Counts the cells that have suspicious values, for a warning. A mergeable reduction with one count per
/// value, as long as there are few values.
class ValueCounts {
  public:
    /// @param value finite @param cells that have it
    void add(double value, std::int64_t cells = 1);
    void merge(const ValueCounts& other);

    void save(ByteWriter& writer) const;
    [[nodiscard]] static ValueCounts load(ByteReader& reader);

    [[nodiscard]] std::int64_t cells() const { return cells_; }
    /// Returns the most frequent value, the lowest one on ties; nothing if there are many values.
    [[nodiscard]] std::optional<SharedValue> most() const;
    /// Returns the number of cells with a value; nothing if there are many values.
    [[nodiscard]] std::optional<std::int64_t> cells_of(double value) const;
    /// Returns "12 cells of 'dem.tif' have the elevation -9999", or "have elevations from -32768 to -9999 (10
    /// of them -9999)".
    [[nodiscard]] std::string text(const std::string& raster) const;

  private:
    static constexpr std::size_t most_values = 32;

    std::int64_t cells_ = 0;
    double lowest_ = std::numeric_limits<double>::infinity();
    double highest_ = -std::numeric_limits<double>::infinity();
    bool many_ = false;
    std::map<double, std::int64_t> counts_;  ///< empty if many_
};

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
            return;
        }
        if (lowest < low_.next)
            for (const double value : values)
                low_.add(value, 1);
        if (highest - lowest <= apart_) {
            // Adds the extremes alone, because no value between them can be far from all others.
            add_to_bin(lowest, 1);
            add_to_bin(highest, 1);
        } else {
            for (const double value : values)
                if (value == value)
                    add_to_bin(value, 1);
        }
    }
    /// Adds cells that have a value within the limits.
    void add(double value, std::int64_t cells) {
        low_.add(value, cells);
        add_to_bin(value, cells);
    }
    void merge(const ValueBins& other);
    void save(ByteWriter& writer) const {
        writer.put_list(bins_);
        writer.put(low_);
    }
    /// Restores bins saved with the same limits and unit.
    void load(ByteReader& reader);

    /// Returns the values shared by at least ten cells and a thousandth of all, and more than 50 m from any
    /// other, ascending. A value that is the only one does not count.
    /// @param cells number of valid cells
    [[nodiscard]] std::vector<SharedValue> shared(std::int64_t cells) const;

    static constexpr double apart_m = 50;

    /// Returns the lowest value if it is shared by a tenth of all cells and more than 2 m below any other, as
    /// a hole is that was filled with it. A lake has a shore.
    [[nodiscard]] std::optional<SharedValue> far_below(std::int64_t cells) const;

    static constexpr double below_m = 2;

  private:
    /// Lowest value and the next one.
    struct Low {
        double value = std::numeric_limits<double>::infinity();
        std::int64_t cells = 0;  ///< that have the lowest value
        double next = std::numeric_limits<double>::infinity();

        /// @param other value, or NaN, which is lower than none
        void add(double other, std::int64_t of_other) {
            if (other < value) {
                next = value;
                value = other;
                cells = of_other;
            } else if (other == value) {
                cells += of_other;
            } else if (other < next) {
                next = other;
            }
        }
    };
    void add_to_bin(double value, std::int64_t cells);

    struct Bin {
        std::int64_t cells = 0;
        double lowest = std::numeric_limits<double>::infinity();
        double highest = -std::numeric_limits<double>::infinity();
    };

    double lowest_;
    double apart_;
    double below_;
    double bins_a_unit_;
    Low low_;
    std::vector<Bin> bins_;
};

/// Formats a value of a raster. Large ones that are exact as 32-bit floats get only the digits that a float
/// needs.
[[nodiscard]] std::string value_text(double value);

/// Inverts scale and offset: returns the stored value of an elevation, rounded if it is nearly an integer.
[[nodiscard]] double stored_value(double elevation, double scale, double offset);

/// Returns the advice for a value that stands for no data in a raster with another NoData value, because a
/// raster has only one: "set these cells to the NoData value 255, for example with gdal_calc.py
/// --calc="where(A==0,255,A)" --NoDataValue=255".
/// @param stored, nodata stored values
[[nodiscard]] std::string second_nodata_advice(double stored, double nodata);

/// Returns "1 cell of 'dem.tif' has " or "12 cells of 'dem.tif' have ".
[[nodiscard]] std::string cells_have(std::int64_t cells, const std::string& raster);

/// Returns the problem of a value that ValueBins finds as a clause without a full stop: "12 cells of
/// 'dem.tif' have the elevation 0, more than 50 m from any other".
[[nodiscard]] std::string isolated_text(const SharedValue& value, const std::string& raster);

/// Same for ValueBins::far_below(): "12 cells of 'dem.tif' have the elevation 0, more than 2 m below any
/// other".
[[nodiscard]] std::string far_below_text(const SharedValue& value, const std::string& raster);

}  // namespace d2b
