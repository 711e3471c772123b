#include "pipeline/random_town.hpp"

#include <algorithm>
#include <limits>
#include <random>

namespace d2b::test {
namespace {

class Town {
  public:
    Town(unsigned seed, const TownKind& kind) : random_(seed), kind_(kind) {
        for (int i = 0; i < kind.rows * kind.cols; ++i)
            z_.push_back(50 + 0.02 * (i % kind.cols) + 0.004 * below(10));
    }
    void block() {
        const int top = below(kind_.rows);
        const int left = below(kind_.cols);
        const int height = 6 + below(30);
        const int width = 6 + below(30);
        const double roof = 56 + 1.5 * below(9);
        const bool rough = below(6) == 0;
        const bool yard = below(4) == 0 && height > 20 && width > 20;
        const bool stepped = below(2) == 0;
        fill(top, left, height, width, roof, rough);
        if (stepped && !rough)
            fill(top + 2, left + 2, height / 2, width / 2, roof + 4, false);
        if (yard)
            fill(top + 8, left + 8, height - 16, width - 16, 50, false);
    }
    /// Houses wall to wall, of other heights.
    void street() {
        const int top = below(kind_.rows - 20);
        int left = below(kind_.cols / 2);
        for (int house = 0; house < 14; ++house) {
            const int width = 7 + below(8);
            fill(top + below(2), left, 9 + below(4), width, 57 + below(7), false);
            left += width;
        }
    }
    void holes() {
        for (double& z : z_)
            if (below(40) == 0)
                z = std::numeric_limits<double>::quiet_NaN();
        for (int i = 0; i < 30; ++i)
            at(below(kind_.rows), below(kind_.cols)) = 90 + 40 * below(4);
    }
    [[nodiscard]] MemorySource source() && { return {kind_.rows, kind_.cols, std::move(z_)}; }

  private:
    [[nodiscard]] int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    [[nodiscard]] double& at(int row, int col) {
        return z_[static_cast<std::size_t>(row * kind_.cols + col)];
    }
    void fill(int top, int left, int height, int width, double roof, bool rough) {
        for (int r = top; r < std::min(kind_.rows, top + height); ++r)
            for (int c = left; c < std::min(kind_.cols, left + width); ++c)
                at(r, c) = roof + (rough ? 0.9 * below(6) : 0.01 * below(6));
    }

    std::mt19937 random_;
    TownKind kind_;
    std::vector<double> z_;
};

}  // namespace

MemorySource random_town(unsigned seed, const TownKind& kind) {
    Town town(seed, kind);
    for (int i = 0; i < kind.blocks; ++i)
        town.block();
    for (int i = 0; kind.with_streets && i < 3; ++i)
        town.street();
    if (kind.with_holes)
        town.holes();
    return std::move(town).source();
}

}  // namespace d2b::test
