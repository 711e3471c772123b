#pragma once

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b::test {

/// A DEM in memory.
class MemorySource : public DemSource {
  public:
    MemorySource(std::int32_t rows, std::int32_t cols, std::vector<double> elevations)
        : elevations_(std::move(elevations)) {
        info_.name = "memory";
        info_.driver = "MEM";
        info_.rows = rows;
        info_.cols = cols;
        info_.window = {0, 0, rows, cols};
    }
    DemInfo& edit() { return info_; }
    [[nodiscard]] const DemInfo& info() const override { return info_; }
    void read(std::int32_t first_row, std::int32_t rows, std::span<double> elevations) override {
        ++std::atomic_ref(reads);  // threads read side by side
        for (std::int32_t i = 0; i < rows; ++i) {
            const auto from = elevations_.begin() + static_cast<std::ptrdiff_t>(first_row + i) * info_.cols +
                              info_.window.col;
            std::copy(from, from + info_.window.cols,
                      elevations.begin() + static_cast<std::ptrdiff_t>(i) * info_.window.cols);
        }
    }
    int reads = 0;

  private:
    DemInfo info_;
    std::vector<double> elevations_;
};

/// A raster in memory.
class MemoryRaster : public RasterSink {
  public:
    void write(std::int32_t rows, std::span<const float> more) override {
        row_count += rows;
        values.insert(values.end(), more.begin(), more.end());
    }
    void finish() override { finished = true; }

    std::int32_t row_count = 0;
    std::vector<float> values;
    bool finished = false;
};

/// Features in memory.
class MemorySink : public FeatureSink {
  public:
    void begin(std::span<const LayerSpec> specs, const Provenance& what) override {
        layers.assign(specs.begin(), specs.end());
        features.resize(layers.size());
        provenance = what;
    }
    void add(std::size_t layer, const Feature& feature) override { features[layer].push_back(feature); }
    void finish() override { finished = true; }

    /// A value by the name of its field.
    [[nodiscard]] FieldValue value(std::size_t layer, std::size_t feature, const std::string& field) const {
        const auto& fields = layers[layer].fields;
        const auto found = std::find_if(fields.begin(), fields.end(),
                                        [&](const FieldSpec& spec) { return spec.name == field; });
        return features[layer][feature].values.at(static_cast<std::size_t>(found - fields.begin()));
    }
    [[nodiscard]] std::int64_t whole(std::size_t layer, std::size_t feature, const std::string& field) const {
        return std::get<std::int64_t>(value(layer, feature, field));
    }
    [[nodiscard]] double number(std::size_t layer, std::size_t feature, const std::string& field) const {
        return std::get<double>(value(layer, feature, field));
    }

    std::vector<LayerSpec> layers;
    std::vector<std::vector<Feature>> features;
    Provenance provenance;
    bool finished = false;
};

}  // namespace d2b::test
