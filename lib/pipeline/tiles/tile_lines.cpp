#include "pipeline/tiles/tile_lines.hpp"

#include <algorithm>
#include <utility>

namespace d2b {
namespace {

/// Rows and columns at the border of a tile that may adjoin squares of its neighbours.
constexpr std::int32_t border = 2;

/// Returns the frame cut to the columns of the extent.
TraceFrame frame_of(const TraceFrame& whole, const Window& seen) {
    TraceFrame frame = whole;
    frame.window.col = seen.col;
    frame.window.cols = seen.cols;
    return frame;
}

/// Returns the wanted runs of columns with a valid elevation outside of the contours of level 1.
/// @param wanted one byte per column, modified @param first column
std::vector<TileOutside> stretches(std::span<std::uint8_t> wanted, std::span<const double> outside,
                                   std::int32_t first) {
    for (std::size_t c = 0; c < wanted.size(); ++c)
        wanted[c] = outside[c] != nothing_outside ? wanted[c] : std::uint8_t{0};
    std::vector<TileOutside> found;
    for (auto end = wanted.begin();;) {
        const auto begin = std::find(end, wanted.end(), 1);
        if (begin == wanted.end())
            return found;
        end = std::find(begin, wanted.end(), 0);
        found.push_back({first + static_cast<std::int32_t>(begin - wanted.begin()),
                         outside.subspan(static_cast<std::size_t>(begin - wanted.begin()),
                                         static_cast<std::size_t>(end - begin))});
    }
}

}  // namespace

TileLines::TileLines(const TraceFrame& frame, TraceMode mode, const Window& seen, const Window& own)
    : frame_(frame),
      seen_(seen),
      own_(own),
      tracer_(frame_of(frame, seen), mode, *this, Outlines::none),
      next_row_(seen.row) {}

/// Keeps only the point sums, because the geometry of contours is cut at the tile's border.
std::int64_t TileLines::take(FinishedContour&& finished) {
    const ContourKey& key = finished.contour.key;
    if (finished.contour.own.n > 0 || finished.sample.size() > 0) {
        const auto line = std::ranges::lower_bound(lines_, key.first.row, {}, &PackedLine::line);
        // Contours that begin in the rows of the tile above continue in the first line.
        line->add({line->line() != key.first.row, key.level, key.first.col - frame_.window.col,
                   finished.contour.own, std::move(finished.sample)});
    }
    return taken_++;
}

void TileLines::add(std::vector<TraceLine>&& lines) {
    for (TraceLine& line : lines)
        add(std::move(line));
}

void TileLines::add(TraceLine&& line) {
    const std::int32_t row = next_row_++;
    const std::int32_t to_window = seen_.col - frame_.window.col;
    if (row >= own_.row) {
        Waiting& waiting = waiting_.emplace_back(Waiting{row, lines_.size(), {}, std::move(line.outside)});
        waiting.squares.reserve(line.squares.top_runs.size());
        for (const TopRun& squares : line.squares.top_runs)
            waiting.squares.push_back(
                {squares.begin + to_window, squares.end + to_window, squares.level + 1});
        lines_.emplace_back(line.line);
    } else {
        line.shares.clear();  // counted by the tile above
    }
    // The lines before the first and after the last row have no squares.
    footprints_.push_back(line.squares.levels.size() > 1 ? line.squares.levels[1] : Runs());
    constexpr std::size_t around = 4;
    if (footprints_.size() > around)
        footprints_.pop_front();
    std::vector<TraceLine> one;
    one.push_back(std::move(line));
    tracer_.trace(std::move(one));
    // In point mode, squares lie between two rows, so those below a row arrive with the next one.
    while (!waiting_.empty() && waiting_.front().row + border <= row) {
        keep(waiting_.front(), waiting_.front().row < own_.row + border);
        waiting_.pop_front();
    }
}

/// @param all keeps all columns, not only those near squares
void TileLines::keep(const Waiting& waiting, bool all) {
    lines_[waiting.line].set(waiting.squares, beside(waiting.outside, all));
}

std::vector<TileOutside> TileLines::beside(std::span<const double> outside, bool all) {
    if (outside.empty())
        return {};
    const auto first = static_cast<std::size_t>(own_.col - seen_.col);
    const auto cols = static_cast<std::size_t>(own_.cols);
    wanted_.assign(first + cols, all ? 1 : 0);
    const auto want = [&](std::int32_t begin, std::int32_t end) {
        std::fill(wanted_.begin() + std::clamp<std::ptrdiff_t>(begin, 0, std::ssize(wanted_)),
                  wanted_.begin() + std::clamp<std::ptrdiff_t>(end, 0, std::ssize(wanted_)), 1);
    };
    const auto begin = static_cast<std::int32_t>(first);
    want(begin, begin + border);
    want(begin + own_.cols - border, begin + own_.cols);
    for (const Runs& runs : footprints_)
        for (const Run& run : runs)
            want(run.begin - 1, run.end + border);
    return stretches(std::span(wanted_).subspan(first), outside.subspan(first, cols),
                     own_.col - frame_.window.col);
}

std::vector<PackedLine> TileLines::finish() {
    for (const Waiting& waiting : waiting_)
        keep(waiting, true);
    waiting_.clear();
    TraceLine end;  // closes all contours, even if the window continues below the tile
    end.line = next_row_;
    end.squares.levels.resize(static_cast<std::size_t>(frame_.levels));
    std::vector<TraceLine> last;
    last.push_back(std::move(end));
    tracer_.trace(std::move(last));
    return std::move(lines_);
}

}  // namespace d2b
