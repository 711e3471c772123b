// From a grid in memory to polygons in memory: no file is read, none is written.
//   grid_to_polygons

#include <cstddef>
#include <cstdint>
#include <dem2buildings/dem2buildings.hpp>
#include <exception>
#include <iomanip>
#include <iostream>
#include <span>
#include <variant>
#include <vector>

namespace {

constexpr std::int32_t rows = 60;
constexpr std::int32_t cols = 80;

/// Cells of a metre: ground that rises to the east, and a house of 12 m by 15 m, 8 m high.
class Village final : public d2b::DemSource {
  public:
    Village() {
        info_.name = "village";
        info_.rows = rows;
        info_.cols = cols;
        info_.window = {0, 0, rows, cols};
        info_.transform = {500000, 1, 0, 5400060, 0, -1};  // the north-west corner, and the cells' sides
        info_.georeferenced = true;
        info_.crs_wkt = "EPSG:25832";
    }
    [[nodiscard]] const d2b::DemInfo& info() const override { return info_; }

    /// Called from several threads at a time.
    void read(const d2b::Window& part, std::span<double> elevations) override {
        std::size_t i = 0;
        for (std::int32_t row = part.row; row < part.end_row(); ++row)
            for (std::int32_t col = part.col; col < part.end_col(); ++col)
                elevations[i++] = elevation(row, col);
    }

  private:
    [[nodiscard]] static double elevation(std::int32_t row, std::int32_t col) {
        const bool house = row >= 20 && row < 32 && col >= 30 && col < 45;
        return house ? 209 : 200 + 0.02 * col;
    }

    d2b::DemInfo info_;
};

/// Keeps the buildings.
class Buildings final : public d2b::FeatureSink {
  public:
    void begin(std::span<const d2b::LayerSpec> /*layers*/, const d2b::Provenance& /*provenance*/) override {}
    void add(std::size_t /*layer*/, const d2b::Feature& feature) override { features.push_back(feature); }
    void finish() override {}

    std::vector<d2b::Feature> features;
};

}  // namespace

int main() {
    try {
        Village dem;
        Buildings buildings;
        d2b::Options options;
        options.write.layers = d2b::Layers::buildings;  // not the contours that they are made of
        const d2b::RunReport report = d2b::run(options, {dem}, {buildings});
        std::cout << std::fixed << std::setprecision(1) << report.buildings << " building in " << report.crs
                  << '\n';
        for (const d2b::Feature& feature : buildings.features) {
            const auto& building = std::get<d2b::BuildingRecord>(feature.record);
            std::cout << "building " << building.id << ", " << building.area_m2 << " m2, roof at "
                      << building.roof << " m:";
            for (const d2b::Position& corner : feature.parts.front().exterior)
                std::cout << ' ' << corner.x << ' ' << corner.y;
            std::cout << '\n';
        }
    } catch (const std::exception& error) {  // a d2b::Error says what is wrong and what to do about it
        std::cerr << error.what() << '\n';
        return 1;
    }
}
