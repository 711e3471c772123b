#include "attributes/ground_level.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace d2b {
namespace {

using Values = std::vector<float>;

/// The terrain in the cells on both sides of each label's border, a value an edge and side.
std::vector<Values> along_borders(const MetreGrid& terrain, const Grid<Label>& labels, Label count) {
    std::vector<Values> along(count + std::size_t{1});
    const auto look = [&](std::size_t i, std::size_t j) {
        if (labels.values[i] == labels.values[j])
            return;
        for (const Label label : {labels.values[i], labels.values[j]})
            if (label != 0)
                for (const std::size_t cell : {i, j})
                    if (!std::isnan(terrain.values[cell]))
                        along[label].push_back(terrain.values[cell]);
    };
    const auto width = static_cast<std::size_t>(labels.cols);
    for (std::int32_t r = 0; r < labels.rows; ++r)
        for (std::int32_t c = 0; c < labels.cols; ++c) {
            const std::size_t i = labels.index(r, c);
            if (c > 0)
                look(i - 1, i);
            if (r > 0)
                look(i - width, i);
        }
    return along;
}

}  // namespace

std::vector<double> ground_levels(const MetreGrid& terrain, const Grid<Label>& labels, Label count) {
    constexpr std::size_t tenth = 10;
    std::vector<Values> along = along_borders(terrain, labels, count);
    // What fills the whole raster has no border: then all of it counts.
    if (!labels.values.empty() && labels.values.front() != 0)
        if (Values& values = along[labels.values.front()]; values.empty())
            std::copy_if(terrain.values.begin(), terrain.values.end(), std::back_inserter(values),
                         [](float z) { return !std::isnan(z); });
    std::vector<double> result(along.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t label = 1; label < along.size(); ++label)
        if (Values& values = along[label]; !values.empty()) {
            const auto rank = values.begin() + static_cast<std::ptrdiff_t>(values.size() / tenth);
            std::nth_element(values.begin(), rank, values.end());
            result[label] = static_cast<double>(*rank);
        }
    return result;
}

}  // namespace d2b
