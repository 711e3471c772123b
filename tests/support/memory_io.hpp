#pragma once

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/surfaces.hpp"

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
    std::vector<double>& values() { return elevations_; }
    [[nodiscard]] const DemInfo& info() const override { return info_; }
    void read(const Window& part, std::span<double> elevations) override {
        ++std::atomic_ref(reads);  // threads read side by side
        for (std::int32_t i = 0; i < part.rows; ++i) {
            const auto from =
                elevations_.begin() + static_cast<std::ptrdiff_t>(part.row + i) * info_.cols + part.col;
            std::copy(from, from + part.cols,
                      elevations.begin() + static_cast<std::ptrdiff_t>(i) * part.cols);
        }
    }
    int reads = 0;

  private:
    DemInfo info_;
    std::vector<double> elevations_;
};

/// A raster in memory, from row 0 and column 0 to the last that were written.
class MemoryRaster : public RasterSink {
  public:
    void write(const Window& part, std::span<const float> more) override {
        cells += part.points();
        make_room(std::max(rows_, part.end_row()), std::max(cols_, part.end_col()));
        for (std::int32_t i = 0; i < part.rows; ++i)
            std::copy_n(more.begin() + static_cast<std::ptrdiff_t>(i) * part.cols, part.cols,
                        values.begin() + static_cast<std::ptrdiff_t>(part.row + i) * cols_ + part.col);
    }
    void finish() override { finished = true; }

    std::int64_t cells = 0;  ///< that were written
    std::vector<float> values;
    bool finished = false;

  private:
    void make_room(std::int32_t rows, std::int32_t cols) {
        if (rows == rows_ && cols == cols_)
            return;
        std::vector<float> larger(static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols));
        for (std::int32_t i = 0; i < rows_; ++i)
            std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i) * cols_, cols_,
                        larger.begin() + static_cast<std::ptrdiff_t>(i) * cols);
        values = std::move(larger);
        rows_ = rows;
        cols_ = cols;
    }
    std::int32_t rows_ = 0;
    std::int32_t cols_ = 0;
};

/// A surface in memory.
class MemorySurface : public SurfaceSink {
  public:
    explicit MemorySurface(SurfaceForm of = SurfaceForm::shell) : form_(of) {}
    [[nodiscard]] SurfaceForm form() const override { return form_; }
    void begin(const SurfaceMeta& what) override { meta = what; }
    void add(const SurfacePart& part) override { parts.push_back(part); }
    void finish() override { finished = true; }

    SurfaceMeta meta;
    std::vector<SurfacePart> parts;
    bool finished = false;

  private:
    SurfaceForm form_;
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
    [[nodiscard]] std::int64_t first_id() const override { return first; }

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

    std::int64_t first = 1;  ///< id of the first features
    std::vector<LayerSpec> layers;
    std::vector<std::vector<Feature>> features;
    Provenance provenance;
    bool finished = false;
};

}  // namespace d2b::test
