#include "read/parcel_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b {
namespace {

/// Half-open range of rows or columns [low, high).
struct Steps {
    std::int32_t low = 0;
    std::int32_t high = 0;
};

std::int32_t within(double value, const Steps& limits) {
    return static_cast<std::int32_t>(
        std::clamp(value, static_cast<double>(limits.low), static_cast<double>(limits.high)));
}

/// Returns the first cell whose centre is not less than `place`.
std::int32_t first_middle(double place, const Steps& limits) {
    return within(std::ceil(place - 0.5), limits);
}

/// Calls use(step, place) for each line through cell centres, within limits, that an edge crosses, with the
/// coordinate of the crossing along that line. @param from, to ends of the edge: coordinate across the lines,
/// then along them
template <typename Use>
void for_crossings(std::pair<double, double> from, std::pair<double, double> to, const Steps& limits,
                   const Use& use) {
    if (to < from)
        std::swap(from, to);
    const double rise = (to.second - from.second) / (to.first - from.first);
    const std::int32_t end = first_middle(to.first, limits);
    for (std::int32_t step = first_middle(from.first, limits); step < end; ++step)
        use(step, from.second + (step + 0.5 - from.first) * rise);
}

class Burner {
  public:
    Burner(const Window& part, std::span<ParcelCell> cells)
        : part_(part), rows_{part.row, part.end_row()}, cols_{part.col, part.end_col()}, cells_(cells) {}

    void fill(const std::vector<WorldRing>& rings, const PixelParcel& parcel);
    void draw(const WorldRing& line);

  private:
    [[nodiscard]] ParcelCell& cell(std::int32_t row, std::int32_t col) {
        return cells_[static_cast<std::size_t>(row - part_.row) * static_cast<std::size_t>(part_.cols) +
                      static_cast<std::size_t>(col - part_.col)];
    }

    Window part_;
    Steps rows_;
    Steps cols_;
    std::span<ParcelCell> cells_;
};

void Burner::fill(const std::vector<WorldRing>& rings, const PixelParcel& parcel) {
    std::vector<std::pair<std::int32_t, std::int32_t>> turns;  // row, and first cell right of an edge
    for (const WorldRing& ring : rings)
        for (std::size_t i = 1; i < ring.size(); ++i)
            for_crossings(
                {ring[i - 1].y, ring[i - 1].x}, {ring[i].y, ring[i].x}, rows_,
                [&](std::int32_t row, double col) { turns.emplace_back(row, first_middle(col, cols_)); });
    std::ranges::sort(turns);
    for (std::size_t i = 0; i + 1 < turns.size(); i += 2)
        for (std::int32_t col = turns[i].second; col < turns[i + 1].second; ++col) {
            ParcelCell& here = cell(turns[i].first, col);
            if (here.parcel != ParcelCell::nobody && here.parcel != parcel.number) {
                here.several = true;
                continue;
            }
            here.parcel = parcel.number;
            here.invalid = !parcel.valid;
        }
}

void Burner::draw(const WorldRing& line) {
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Position& a = line[i - 1];
        const Position& b = line[i];
        for_crossings({a.y, a.x}, {b.y, b.x}, rows_, [&](std::int32_t row, double col) {
            const double left = std::ceil(col - 0.5) - 1;
            if (left >= cols_.low && left < cols_.high)
                cell(row, static_cast<std::int32_t>(left)).cut_right = true;
        });
        for_crossings({a.x, a.y}, {b.x, b.y}, cols_, [&](std::int32_t col, double row) {
            const double above = std::ceil(row - 0.5) - 1;
            if (above >= rows_.low && above < rows_.high)
                cell(static_cast<std::int32_t>(above), col).cut_below = true;
        });
    }
}

}  // namespace

void burn(const PixelParcel& parcel, const Window& part, std::span<ParcelCell> cells) {
    Burner burner(part, cells);
    for (const std::vector<WorldRing>& rings : parcel.polygons)
        burner.fill(rings, parcel);
    for (const WorldRing& line : parcel.lines)
        burner.draw(line);
}

}  // namespace d2b
