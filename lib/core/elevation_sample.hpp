#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/byte_record.hpp"

namespace d2b {

/// Range divided into the bins of a histogram. The same for a whole run, so that histograms can be merged.
struct ElevationRange {
    double minimum = 0;
    double maximum = 0;

    static constexpr std::uint32_t bins = 65536;
    [[nodiscard]] std::uint32_t bin(double elevation) const;
    /// Returns the centre of the bin.
    [[nodiscard]] double elevation(std::uint32_t bin) const;
};

/// Elevations of a building, for percentiles. Exact up to 2^17 points (1 MiB); above that, a histogram of 512
/// KiB with a resolution of 1/65,536 of the DEM's range. The choice depends only on the number of points, so
/// the result does not depend on their order.
class ElevationSample {
  public:
    static constexpr std::size_t largest_list = std::size_t{1} << 17;

    void add(double elevation, const ElevationRange& range);
    /// Adds all values that are not NaN.
    void add(std::span<const double> elevations, const ElevationRange& range);
    /// @param other left empty
    void merge(ElevationSample& other, const ElevationRange& range);
    [[nodiscard]] std::int64_t size() const { return size_; }
    /// Computes percentiles by nearest rank: the lowest elevation that at least this share of the points does
    /// not exceed. A share of 1 gives the maximum, which is always exact. @param shares 0 to 1, ascending
    /// @pre size() > 0
    [[nodiscard]] std::vector<double> percentiles(const std::vector<double>& shares,
                                                  const ElevationRange& range) const;

    /// Halves the size if all elevations are exact as floats.
    void save(ByteWriter& writer) const;
    /// @throws BrokenRecord
    [[nodiscard]] static ElevationSample load(ByteReader& reader);

  private:
    void make_histogram(const ElevationRange& range);
    void count(double elevation, const ElevationRange& range);

    std::int64_t size_ = 0;
    std::vector<double> values_;
    std::vector<std::uint32_t> histogram_;
    double highest_ = -std::numeric_limits<double>::infinity();  ///< maximum of the values in the histogram
};

}  // namespace d2b
