#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

#include "support/random_grid.hpp"

namespace d2b::test {

/// Input of a fuzzer, byte by byte; zeros after its end.
class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

    unsigned next() {
        if (left_.empty())
            return 0;
        const unsigned byte = left_.front();
        left_ = left_.subspan(1);
        return byte;
    }
    unsigned below(unsigned n) { return next() % n; }
    [[nodiscard]] std::string rest() const { return {left_.begin(), left_.end()}; }

  private:
    std::span<const std::uint8_t> left_;
};

/// Ends the program if a condition does not hold, because fuzzers look for such an end.
inline void demand(bool holds, const char* what) {
    if (holds)
        return;
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
}

/// @param fault "" where all is well
inline void demand_none(const std::string& fault) {
    demand(fault.empty(), fault.c_str());
}

/// A grid of few values with its thresholds: the first bytes say how large, of which kind, then comes a byte
/// a cell.
inline RandomGridCase grid_of(Bytes& bytes, unsigned largest) {
    RandomGridCase result;
    TraceGrid& grid = result.grid;
    grid.rows = static_cast<std::int32_t>(1 + bytes.below(largest));
    grid.cols = static_cast<std::int32_t>(1 + bytes.below(largest));
    const unsigned kind = bytes.next();
    result.mode = kind % 2 == 0 ? TraceMode::cells : TraceMode::points;
    const bool labelled = kind / 2 % 2 != 0;
    for (std::int32_t i = 0; i < grid.rows * grid.cols; ++i) {
        const unsigned cell = bytes.next();
        grid.z.push_back(cell / 8 % 8 == 7 ? nodata : cell % 5);
        if (labelled)
            grid.labels.push_back(cell / 64);
    }
    for (int t = 0; t < 4; ++t)
        result.thresholds.push_back(t + 0.5);
    return result;
}

}  // namespace d2b::test
