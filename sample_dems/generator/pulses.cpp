#include "pulses.hpp"

#include <algorithm>
#include <cmath>

#include "random.hpp"

namespace d2b::sample {

PulseRows pulses_over(const Grid& grid, const Survey& survey, std::uint64_t seed, std::int32_t first_row,
                      std::int32_t rows) {
    const double side = 1 / std::sqrt(survey.pulses);
    const double top = (grid.rows - first_row) * grid.cell_y;
    const double bottom = top - rows * grid.cell_y;
    const auto square = [side](double metres) {
        return static_cast<std::int64_t>(std::floor(metres / side));
    };

    std::vector<Pulse> found;
    std::vector<std::size_t> cells;
    PulseRows result;
    result.first.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(grid.cols) + 1, 0);
    for (std::int64_t j = square(bottom); j <= square(top); ++j)
        for (std::int64_t i = 0; i <= square(grid.cols * grid.cell_x); ++i) {
            Random random(hash(seed, i, j));
            const Position at{(static_cast<double>(i) + random.uniform()) * side,
                              (static_cast<double>(j) + random.uniform()) * side};
            const bool kept = random.uniform() < survey.kept;
            const auto col = static_cast<std::int32_t>(std::floor(at.x / grid.cell_x));
            const auto row =
                static_cast<std::int32_t>(std::floor(grid.rows - at.y / grid.cell_y)) - first_row;
            if (!kept || col < 0 || col >= grid.cols || row < 0 || row >= rows)
                continue;
            found.push_back({at, random.next()});
            cells.push_back(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.cols) +
                            static_cast<std::size_t>(col));
            ++result.first[cells.back() + 1];
        }

    for (std::size_t cell = 1; cell < result.first.size(); ++cell)
        result.first[cell] += result.first[cell - 1];
    std::vector<std::size_t> next(result.first.begin(), result.first.end() - 1);
    result.pulses.resize(found.size());
    for (std::size_t k = 0; k < found.size(); ++k)
        result.pulses[next[cells[k]]++] = found[k];
    return result;
}

}  // namespace d2b::sample
