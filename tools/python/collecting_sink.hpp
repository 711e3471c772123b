#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Values of one field of all features of a layer.
struct FieldColumn {
    std::variant<std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>> values;
    std::vector<std::uint8_t> null;  ///< one a feature; where it is not 0, the value is 0, NaN or ""
};

/// Features in memory, in the order in which they came.
struct CollectedLayer {
    LayerSpec spec;
    std::string crs_wkt;               ///< of the coordinates; "" for none
    std::vector<FieldColumn> columns;  ///< one a field of the spec
    std::vector<Feature> features;     ///< without their values, which are in the columns
};

/// Keeps all features.
class CollectingSink final : public FeatureSink {
  public:
    void begin(std::span<const LayerSpec> layers, const Provenance& provenance) override;
    void add(std::size_t layer, const Feature& feature) override;
    void finish() override {}

    [[nodiscard]] const std::vector<std::shared_ptr<CollectedLayer>>& collected() const { return layers_; }
    [[nodiscard]] const Provenance& provenance() const { return provenance_; }

  private:
    std::vector<std::shared_ptr<CollectedLayer>> layers_;
    Provenance provenance_;
};

}  // namespace d2b
