#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <dem2buildings/dem2buildings.hpp>
#include <iostream>
#include <span>
#include <string>
#include <vector>

namespace {

constexpr std::int32_t kRows = 12;
constexpr std::int32_t kCols = 10;

/// Flat ground of 2 m with a block of 5 x 6 points, 12 m high.
class Block : public d2b::DemSource {
  public:
    Block() {
        info_.name = "block";
        info_.rows = kRows;
        info_.cols = kCols;
        info_.window = {0, 0, kRows, kCols};
    }
    [[nodiscard]] const d2b::DemInfo& info() const override { return info_; }
    void read(std::int32_t first_row, std::int32_t rows, std::span<double> elevations) override {
        std::size_t i = 0;
        for (std::int32_t row = first_row; row < first_row + rows; ++row)
            for (std::int32_t col = 0; col < kCols; ++col)
                elevations[i++] = row >= 3 && row < 8 && col >= 2 && col < 8 ? 12 : 2;
    }

  private:
    d2b::DemInfo info_;
};

class Counter : public d2b::FeatureSink {
  public:
    void begin(std::span<const d2b::LayerSpec> layers, const d2b::Provenance&) override {
        for (const d2b::LayerSpec& layer : layers)
            names_.push_back(layer.name);
        counts_.resize(layers.size());
    }
    void add(std::size_t layer, const d2b::Feature&) override { ++counts_[layer]; }
    void finish() override { finished_ = true; }

    /// 0 until all is done.
    [[nodiscard]] int count(const std::string& layer) const {
        const auto found = std::find(names_.begin(), names_.end(), layer);
        if (!finished_ || found == names_.end())
            return 0;
        return counts_[static_cast<std::size_t>(found - names_.begin())];
    }

  private:
    std::vector<std::string> names_;
    std::vector<int> counts_;
    bool finished_ = false;
};

}  // namespace

int main() {
    d2b::Options options;
    options.preset = d2b::Preset::thesis;
    options.levels.fixed = {7};
    Block source;
    Counter sink;
    d2b::run(options, {source}, {sink});
    // The contours are the root, which every valid point belongs to, and the block.
    std::cout << "dem2buildings " << d2b::version << ": " << sink.count("buildings") << " building, "
              << sink.count("contours") << " contours\n";
    return sink.count("buildings") == 1 && sink.count("contours") == 2 ? 0 : 1;
}
