#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/byte_record.hpp"

namespace d2b {

/// The range that the bins of a histogram divide; the same for a whole run, so that histograms merge.
struct ElevationRange {
    double minimum = 0;
    double maximum = 0;

    static constexpr std::uint32_t bins = 65536;
    [[nodiscard]] std::uint32_t bin(double elevation) const;
    /// The bin's middle.
    [[nodiscard]] double elevation(std::uint32_t bin) const;
};

/// The elevations of a building, for percentiles. Exact up to 2^17 points (1 MiB); above, a histogram of 512
/// KiB that is exact to a 65,536th of the DEM's range. Which of the two depends on their number alone, so the
/// result does not depend on the order of the points.
class ElevationSample {
  public:
    static constexpr std::size_t largest_list = std::size_t{1} << 17;

    void add(double elevation, const ElevationRange& range);
    /// Those that are not NaN.
    void add(std::span<const double> elevations, const ElevationRange& range);
    /// @param other left empty
    void merge(ElevationSample& other, const ElevationRange& range);
    [[nodiscard]] std::int64_t size() const { return size_; }
    /// Nearest ranks: the lowest elevations that at least these shares of the points do not exceed.
    /// The last, of all of them, is the highest and always exact.
    /// @param shares 0 to 1, ascending @pre size() > 0
    [[nodiscard]] std::vector<double> percentiles(const std::vector<double>& shares,
                                                  const ElevationRange& range) const;

    /// Takes half of the room where elevations are floats.
    void save(ByteWriter& writer) const;
    /// @throws BrokenRecord
    [[nodiscard]] static ElevationSample load(ByteReader& reader);

  private:
    void make_histogram(const ElevationRange& range);
    void count(double elevation, const ElevationRange& range);

    std::int64_t size_ = 0;
    std::vector<double> values_;
    std::vector<std::uint32_t> histogram_;
    double highest_ = -std::numeric_limits<double>::infinity();  ///< of what is in the histogram
};

}  // namespace d2b
