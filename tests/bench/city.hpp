#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "render.hpp"
#include "town_plan.hpp"

namespace d2b::bench {

/// A square city of any size. Each place is drawn from the seed and the place alone, so that any rows
/// can be rendered without the others, and a larger city of the same seed is no other kind of city.
struct CitySpec {
    std::int32_t side = 2000;  ///< cells along an edge
    double cell = 1;           ///< metres
    std::uint64_t seed = 1;
};

/// Renders a city from its first row to its last, a strip of rows at a time; memory is a strip of quarters.
class City {
  public:
    /// A cell where nothing was measured.
    static constexpr double nodata = -9999;

    City(const CitySpec& spec, int threads);

    [[nodiscard]] const sample::Grid& grid() const { return grid_; }
    /// Elevations of whole rows in metres, rounded to centimetres. They do not depend on the number of
    /// threads, nor on how a city is divided into strips.
    /// @param first_row not above that of an earlier call, for quarters above it are forgotten
    /// @param elevations rows * grid().cols values
    void render(std::int32_t first_row, std::int32_t rows, std::span<float> elevations);

  private:
    using Quarters = std::vector<sample::Scene>;  // from west to east

    void build_quarters(std::int32_t first_row, std::int32_t rows);
    [[nodiscard]] sample::Scene build_quarter(std::int32_t col, std::int32_t row) const;
    template <typename Visit>
    void for_quarters(const Visit& visit) const;
    void render_part(std::int32_t first_row, std::int32_t rows, std::span<float> elevations) const;

    CitySpec spec_;
    int threads_;
    sample::Grid grid_;
    sample::TownPlan plan_;
    sample::Scene bare_;                         // ground and noise, nothing on it
    std::map<std::int32_t, Quarters> quarters_;  // by the plan's row
};

}  // namespace d2b::bench
