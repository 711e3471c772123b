#pragma once

#include <cstdint>
#include <vector>

namespace d2b {

/// The range that the bins of an ElevationSample divide; the same for a whole run, so that samples merge.
struct ElevationRange {
    double minimum = 0;
    double maximum = 0;

    static constexpr std::uint32_t bins = 65536;
    [[nodiscard]] std::uint16_t bin(double elevation) const;
    /// The bin's middle.
    [[nodiscard]] double elevation(std::uint32_t bin) const;
};

/// The elevations of a building, for percentiles: exact to a 65,536th of the DEM's range, whatever the order
/// of the points. Two bytes a point up to 2^18 points, a histogram of 512 KiB above.
class ElevationSample {
  public:
    void add(std::uint16_t bin);
    /// @param other left empty
    void merge(ElevationSample& other);
    [[nodiscard]] std::int64_t size() const { return size_; }
    /// Nearest rank: the lowest elevation that at least the share of the points do not exceed.
    /// @param share 0 to 1 @pre size() > 0
    [[nodiscard]] double percentile(double share, const ElevationRange& range) const;
    /// Several at once, ascending shares. @pre size() > 0
    [[nodiscard]] std::vector<double> percentiles(const std::vector<double>& shares,
                                                  const ElevationRange& range) const;

  private:
    void make_histogram();

    std::int64_t size_ = 0;
    std::vector<std::uint16_t> values_;
    std::vector<std::uint32_t> histogram_;
};

}  // namespace d2b
