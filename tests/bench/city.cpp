#include "city.hpp"

#include <algorithm>
#include <cmath>

#include "bare_ground.hpp"
#include "downtown.hpp"
#include "in_threads.hpp"
#include "random.hpp"
#include "surface.hpp"
#include "thickets.hpp"

namespace d2b::bench {

namespace {

sample::Grid city_grid(const CitySpec& spec) {
    return {spec.side, spec.side, spec.cell, spec.cell, {391000, spec.cell, 0, 5821000, 0, -spec.cell}};
}

sample::TownPlan city_plan(const CitySpec& spec) {
    sample::TownPlan plan;
    plan.seed = spec.seed;
    // The streets do not end at the raster's edge.
    plan.cols = plan.rows = static_cast<std::int32_t>(std::ceil(spec.side * spec.cell / plan.pitch)) + 1;
    return plan;
}

}  // namespace

City::City(const CitySpec& spec, int threads)
    : spec_(spec), threads_(threads), grid_(city_grid(spec)), plan_(city_plan(spec)) {
    bare_.seed = sample::mix(spec.seed);
    bare_.ground = {bare_.seed, 20, 0, 0, 34, {}, {}};
}

sample::Scene City::build_quarter(std::int32_t col, std::int32_t row) const {
    sample::Scene scene = bare_;
    if (is_downtown(plan_, col, row))
        build_downtown(plan_, col, row, scene);
    else
        sample::build_quarter(plan_, col, row, scene);
    return scene;
}

void City::build_quarters(std::int32_t first_row, std::int32_t rows) {
    // Rows of the plan count from the south.
    const auto row_at = [this](double y) {
        return static_cast<std::int32_t>(std::clamp(std::floor(y / plan_.pitch), 0.0, plan_.rows - 1.0));
    };
    const double north = grid_.centre(first_row, 0).y;
    const double south = grid_.centre(first_row + rows - 1, 0).y;
    const std::int32_t first = row_at(south - plan_.jitter);
    const std::int32_t last = row_at(north + plan_.jitter);
    quarters_.erase(quarters_.upper_bound(last), quarters_.end());
    for (std::int32_t row = first; row <= last; ++row) {
        if (quarters_.contains(row))
            continue;
        Quarters& built = quarters_[row];
        built.resize(static_cast<std::size_t>(plan_.cols));
        in_threads(threads_, plan_.cols, [&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t col = begin; col < end; ++col)
                built[static_cast<std::size_t>(col)] = build_quarter(col, row);
        });
    }
}

void City::render(std::int32_t first_row, std::int32_t rows, std::span<float> elevations) {
    build_quarters(first_row, rows);
    in_threads(threads_, rows, [&](std::int32_t begin, std::int32_t end) {
        const auto cols = static_cast<std::size_t>(grid_.cols);
        render_part(first_row + begin, end - begin,
                    elevations.subspan(static_cast<std::size_t>(begin) * cols,
                                       static_cast<std::size_t>(end - begin) * cols));
    });
}

template <typename Visit>
void City::for_quarters(const Visit& visit) const {
    for (const auto& [row, quarters] : quarters_) {
        for (const sample::Scene& scene : quarters)
            visit(scene);
    }
}

void City::render_part(std::int32_t first_row, std::int32_t rows, std::span<float> elevations) const {
    std::vector<double> metres(elevations.size());
    std::vector<char> built(elevations.size());
    lay_ground(bare_.ground, grid_, first_row, rows, metres);
    for_quarters([&](const sample::Scene& scene) {
        lay_earthworks(scene.ground, grid_, first_row, rows, metres);
        mark_built(scene, grid_, first_row, rows, built);
    });
    roughen(bare_.seed, grid_, first_row, rows, metres);
    plant_thickets(bare_.seed, grid_, first_row, rows, built, metres);
    for_quarters([&](const sample::Scene& scene) { sample::raise(scene, grid_, first_row, rows, metres); });
    measure(bare_.seed, grid_, first_row, rows, metres, elevations);
}

}  // namespace d2b::bench
