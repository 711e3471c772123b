#include "detect/part_seam.hpp"

#include <algorithm>
#include <cmath>

namespace d2b {
namespace {

constexpr double straight = 1.3;  // cells, RMS

}  // namespace

void PartSeam::add(std::int32_t row, std::int32_t col, int down, int across, const CellSize& cell) {
    middles_.push_back({(col + 0.5 + 0.5 * across) * cell.across, (row + 0.5 + 0.5 * down) * cell.down});
    to_rest_.x += across * cell.down;
    to_rest_.y += down * cell.across;
}

double PartSeam::free_share() const {
    const auto free = static_cast<double>(free_);
    return middles_.empty() ? 1 : free / (free + static_cast<double>(middles_.size()));
}

std::optional<SeamLine> PartSeam::straight_line(const CellSize& cell) const {
    if (middles_.empty())
        return std::nullopt;
    const auto n = static_cast<double>(middles_.size());
    SeamLine line;
    for (const MetrePlace& p : middles_) {
        line.middle.x += p.x / n;
        line.middle.y += p.y / n;
    }
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const MetrePlace& p : middles_) {
        const double x = p.x - line.middle.x;
        const double y = p.y - line.middle.y;
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    const double spread = std::sqrt((xx - yy) * (xx - yy) + 4 * xy * xy);
    if ((xx + yy - spread) / 2 > n * straight * straight * cell.area())
        return std::nullopt;
    // Half of the angle of (xx - yy, 2 xy).
    const double turned = spread > 0 ? (xx - yy) / spread : 1;
    line.along = {std::sqrt((1 + turned) / 2), std::copysign(std::sqrt((1 - turned) / 2), xy)};
    line.inward = {-line.along.y, line.along.x};
    if (line.inward.x * to_rest_.x + line.inward.y * to_rest_.y < 0)
        line.inward = {line.along.y, -line.along.x};
    for (const MetrePlace& p : middles_) {
        const double t = (p.x - line.middle.x) * line.along.x + (p.y - line.middle.y) * line.along.y;
        line.first = std::min(line.first, t);
        line.last = std::max(line.last, t);
    }
    return line;
}

std::vector<PartSeam> seams_of(const DetectedObjects& parts, const Mask& rest, const CellSize& cell,
                               Executor& threads) {
    std::vector<PartSeam> seams(parts.regions.count());
    for_runs_by_label(threads, parts.regions, [&](std::int32_t r, const RegionRun& run) {
        PartSeam& seam = seams[run.label - 1];
        const auto look = [&](std::int32_t c, int down, int across) {
            const std::int32_t y = r + down;
            const std::int32_t x = c + across;
            if (y < 0 || x < 0 || y >= rest.rows || x >= rest.cols)
                return;
            if (rest.at(y, x) != 0)
                seam.add(r, c, down, across, cell);
            else if (parts.cells.at(y, x) == 0)
                seam.add_free();
        };
        look(run.begin, 0, -1);
        look(run.end - 1, 0, 1);
        for (std::int32_t c = run.begin; c < run.end; ++c) {
            look(c, -1, 0);
            look(c, 1, 0);
        }
    });
    return seams;
}

}  // namespace d2b
