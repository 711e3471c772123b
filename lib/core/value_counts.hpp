#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "core/byte_record.hpp"

namespace d2b {

/// An exact value and how many cells have it.
struct SharedValue {
    double value = 0;
    std::int64_t cells = 0;
};

/// How many cells have values that are worth a warning, and which. A mergeable reduction: each value has its
/// own count as long as there are few.
class ValueCounts {
  public:
    /// @param value finite @param cells that have it
    void add(double value, std::int64_t cells = 1);
    void merge(const ValueCounts& other);

    void save(ByteWriter& writer) const;
    [[nodiscard]] static ValueCounts load(ByteReader& reader);

    [[nodiscard]] std::int64_t cells() const { return cells_; }
    /// The value that most cells have, the lowest of several such; nothing where there are many values.
    [[nodiscard]] std::optional<SharedValue> most() const;
    /// How many have a value; nothing where there are many values.
    [[nodiscard]] std::optional<std::int64_t> cells_of(double value) const;
    /// "12 cells of 'dem.tif' have the elevation -9999", or "have elevations from -32768 to -9999 (10 of them
    /// -9999)".
    [[nodiscard]] std::string text(const std::string& raster) const;

  private:
    static constexpr std::size_t most_values = 32;

    std::int64_t cells_ = 0;
    double lowest_ = std::numeric_limits<double>::infinity();
    double highest_ = -std::numeric_limits<double>::infinity();
    bool many_ = false;
    std::map<double, std::int64_t> counts_;  ///< empty where there are many
};

/// Of a value of a raster. Large ones that are 32-bit floats have no more digits than these need.
[[nodiscard]] std::string value_text(double value);

/// The value as stored that scale and offset make an elevation of: the whole number where it is next to one.
[[nodiscard]] double stored_value(double elevation, double scale, double offset);

/// "1 cell of 'dem.tif' has ", "12 cells of 'dem.tif' have ".
[[nodiscard]] std::string cells_have(std::int64_t cells, const std::string& raster);

}  // namespace d2b
