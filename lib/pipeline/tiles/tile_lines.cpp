#include "pipeline/tiles/tile_lines.hpp"

#include <algorithm>
#include <utility>

namespace d2b {
namespace {

/// Rows and columns at the borders of a tile beside which squares of others may lie.
constexpr std::int32_t border = 2;

/// Those of the window that the cells or points seen are cut for.
TraceFrame frame_of(const TraceFrame& whole, const Window& seen) {
    TraceFrame frame = whole;
    frame.window.col = seen.col;
    frame.window.cols = seen.cols;
    return frame;
}

}  // namespace

TileLines::TileLines(const TraceFrame& frame, TraceMode mode, const Window& seen, const Window& own)
    : frame_(frame),
      seen_(seen),
      own_(own),
      tracer_(frame_of(frame, seen), mode, *this, Outlines::none),
      next_row_(seen.row) {}

/// Contours end where the tile does; what their points add up to is what counts.
std::int64_t TileLines::take(FinishedContour&& finished) {
    const ContourKey& key = finished.contour.key;
    if (finished.contour.own.n > 0 || finished.sample.size() > 0)
        sums_.push_back({key.first,
                         {false, key.level, key.first.col - frame_.window.col, finished.contour.own,
                          std::move(finished.sample)}});
    return taken_++;
}

void TileLines::add(std::vector<TraceLine>&& lines) {
    for (TraceLine& line : lines)
        add(std::move(line));
}

void TileLines::add(TraceLine&& line) {
    const std::int32_t row = next_row_++;
    const bool is_own = row >= own_.row;
    const std::int32_t to_window = seen_.col - frame_.window.col;
    if (is_own) {
        TileLine& kept = lines_.emplace_back();
        kept.line = line.line;
        kept.squares.reserve(line.squares.top_runs.size());
        for (const TopRun& squares : line.squares.top_runs)
            kept.squares.push_back({squares.begin + to_window, squares.end + to_window, squares.level + 1});
        if (!line.outside.empty())
            beside_.push_back({row, lines_.size() - 1, std::move(line.outside)});
    } else {
        line.shares.clear();  // which the tile above has
    }
    // What comes before the first line, and behind the last, has no squares.
    footprints_.push_back(line.squares.levels.size() > 1 ? line.squares.levels[1] : Runs());
    constexpr std::size_t around = 4;
    if (footprints_.size() > around)
        footprints_.pop_front();
    std::vector<TraceLine> one;
    one.push_back(std::move(line));
    tracer_.trace(std::move(one));
    // Of points squares lie between two rows: those below a row come with the next one.
    while (!beside_.empty() && beside_.front().row + border <= row) {
        keep_beside(beside_.front(), beside_.front().row < own_.row + border);
        beside_.pop_front();
    }
}

/// @param all whatever squares are known to be around
void TileLines::keep_beside(const Beside& beside, bool all) {
    const auto first = static_cast<std::size_t>(own_.col - seen_.col);
    const auto cols = static_cast<std::size_t>(own_.cols);
    std::vector<bool> wanted(cols + first, all);
    const auto want = [&](std::int32_t begin, std::int32_t end) {
        std::fill(wanted.begin() + std::clamp<std::ptrdiff_t>(begin, 0, std::ssize(wanted)),
                  wanted.begin() + std::clamp<std::ptrdiff_t>(end, 0, std::ssize(wanted)), true);
    };
    const auto begin = static_cast<std::int32_t>(first);
    want(begin, begin + border);
    want(begin + own_.cols - border, begin + own_.cols);
    for (const Runs& runs : footprints_)
        for (const Run& run : runs)
            want(run.begin - 1, run.end + border);
    std::vector<TileLine::Outside>& kept = lines_[beside.line].outside;
    bool goes_on = false;
    for (std::size_t c = first; c < first + cols; ++c) {
        const double z = beside.outside[c];
        const bool keeps = wanted[c] && z != nothing_outside;
        if (keeps && !goes_on)
            kept.push_back({static_cast<std::int32_t>(c) + seen_.col - frame_.window.col, {}});
        if (keeps)
            kept.back().elevations.push_back(z);
        goes_on = keeps;
    }
}

std::vector<TileLine> TileLines::finish() {
    for (const Beside& beside : beside_)
        keep_beside(beside, true);
    TraceLine end;  // where the window goes on, what the tile has seen of contours ends all the same
    end.line = next_row_;
    end.squares.levels.resize(static_cast<std::size_t>(frame_.levels));
    std::vector<TraceLine> last;
    last.push_back(std::move(end));
    tracer_.trace(std::move(last));
    for (Sum& sum : sums_)
        place(std::move(sum));
    sums_.clear();
    return std::move(lines_);
}

void TileLines::place(Sum&& sum) {
    const auto line = std::ranges::lower_bound(lines_, sum.first.row, {}, &TileLine::line);
    // What begins in rows of the tile above goes on in the first line.
    sum.sum.above = line->line != sum.first.row;
    line->sums.push_back(std::move(sum.sum));
}

}  // namespace d2b
