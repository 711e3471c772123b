#include "detect/ground_level.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

namespace d2b::detect {
namespace {

using Values = std::vector<float>;

/// Terrain in the cells on both sides of label borders, one value per edge and side.
class BorderTerrain {
  public:
    BorderTerrain(const MetreGrid& terrain, const Grid<Label>& labels) : terrain_(terrain), labels_(labels) {}

    struct Value {
        Label label;
        float terrain;
    };

    [[nodiscard]] std::vector<Value> in(RowBand band) const {
        std::vector<Value> values;
        std::vector<std::uint8_t> edges(static_cast<std::size_t>(labels_.cols));
        for (std::int32_t r = band.begin; r < band.end; ++r) {
            const std::size_t row = labels_.index(r, 0);
            const std::size_t above = labels_.index(std::max(r - 1, 0), 0);
            find_edges(labels_.row(r), labels_.values.data() + above, edges);
            for (auto edge = std::find(edges.begin(), edges.end(), 1); edge != edges.end();
                 edge = std::find(edge + 1, edges.end(), 1)) {
                const auto c = static_cast<std::size_t>(edge - edges.begin());
                if (c > 0)
                    visit(row + c - 1, row + c, values);
                visit(above + c, row + c, values);
            }
        }
        return values;
    }

  private:
    /// Sets 1 if a cell's label differs from that to the left or above. Branch-free, so that the loop
    /// vectorises, because most cells have no edge.
    static void find_edges(std::span<const Label> here, const Label* above,
                           std::vector<std::uint8_t>& edges) {
        const auto differ = [](Label a, Label b) { return a != b ? 1 : 0; };
        if (!here.empty())
            edges[0] = static_cast<std::uint8_t>(differ(here[0], above[0]));
        for (std::size_t c = 1; c < here.size(); ++c)
            edges[c] = static_cast<std::uint8_t>(differ(here[c], here[c - 1]) | differ(here[c], above[c]));
    }

    void visit(std::size_t i, std::size_t j, std::vector<Value>& values) const {
        if (labels_.values[i] == labels_.values[j])
            return;
        for (const Label label : {labels_.values[i], labels_.values[j]})
            if (label != 0)
                for (const std::size_t cell : {i, j})
                    if (!std::isnan(terrain_.values[cell]))
                        values.push_back({label, terrain_.values[cell]});
    }

    const MetreGrid& terrain_;
    const Grid<Label>& labels_;
};

std::vector<Values> along_borders(const MetreGrid& terrain, const Grid<Label>& labels, Label count,
                                  Executor& threads) {
    const BorderTerrain border(terrain, labels);
    const std::vector<RowBand> bands = row_bands(labels.rows, labels.cols);
    std::vector<std::vector<BorderTerrain::Value>> found(bands.size());
    threads.for_each(bands.size(), [&](std::size_t i) { found[i] = border.in(bands[i]); });
    std::vector<Values> along(count + std::size_t{1});
    for (std::vector<BorderTerrain::Value>& some : found)
        for (const auto& [label, z] : std::exchange(some, {}))
            along[label].push_back(z);
    return along;
}

}  // namespace

std::vector<double> ground_levels(const MetreGrid& terrain, const Grid<Label>& labels, Label count,
                                  Executor& threads) {
    constexpr std::size_t tenth = 10;
    constexpr std::size_t labels_at_once = 64;
    std::vector<Values> along = along_borders(terrain, labels, count, threads);
    // An object that fills the whole raster has no border, so all its cells count.
    if (!labels.values.empty() && labels.values.front() != 0)
        if (Values& values = along[labels.values.front()]; values.empty())
            std::copy_if(terrain.values.begin(), terrain.values.end(), std::back_inserter(values),
                         [](float z) { return !std::isnan(z); });
    std::vector<double> result(along.size(), std::numeric_limits<double>::quiet_NaN());
    threads.for_chunks(along.size(), labels_at_once, [&](std::size_t begin, std::size_t end) {
        for (std::size_t label = begin; label < end; ++label)
            if (Values& values = along[label]; !values.empty()) {
                const auto rank = values.begin() + static_cast<std::ptrdiff_t>(values.size() / tenth);
                std::nth_element(values.begin(), rank, values.end());
                result[label] = static_cast<double>(*rank);
            }
    });
    return result;
}

}  // namespace d2b::detect
