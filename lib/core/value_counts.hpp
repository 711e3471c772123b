#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "core/byte_record.hpp"

namespace d2b {

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

/// Formats a value of a raster. Large ones that are exact as 32-bit floats get only the digits that a float
/// needs.
[[nodiscard]] std::string value_text(double value);

/// Inverts scale and offset: returns the stored value of an elevation, rounded if it is nearly an integer.
[[nodiscard]] double stored_value(double elevation, double scale, double offset);

/// Returns "1 cell of 'dem.tif' has " or "12 cells of 'dem.tif' have ".
[[nodiscard]] std::string cells_have(std::int64_t cells, const std::string& raster);

}  // namespace d2b
