#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "core/number_text.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/band_reader.hpp"
#include "read/cutline_mask.hpp"
#include "read/raster_crs.hpp"
#include "read/raster_transform.hpp"
#include "read/start_gdal.hpp"
#include "read/window.hpp"

namespace d2b {
namespace {

const std::byte* at(const StridedValues& values, std::int32_t row, std::int32_t col) {
    return static_cast<const std::byte*>(values.first) + row * values.row_step + col * values.col_step;
}

template <typename Value>
void read_as(const StridedValues& values, const Window& part, double* elevations) {
    for (std::int32_t row = part.row; row < part.row + part.rows; ++row) {
        const std::byte* cell = at(values, row, part.col);
        for (std::int32_t col = 0; col < part.cols; ++col, cell += values.col_step) {
            Value value{};
            std::memcpy(&value, cell, sizeof(Value));
            *elevations++ = static_cast<double>(value);
        }
    }
}

void read_values(const ElevationArray& array, const Window& part, double* elevations) {
    switch (array.type) {
        case ValueType::int8:
            return read_as<std::int8_t>(array.values, part, elevations);
        case ValueType::uint8:
            return read_as<std::uint8_t>(array.values, part, elevations);
        case ValueType::int16:
            return read_as<std::int16_t>(array.values, part, elevations);
        case ValueType::uint16:
            return read_as<std::uint16_t>(array.values, part, elevations);
        case ValueType::int32:
            return read_as<std::int32_t>(array.values, part, elevations);
        case ValueType::uint32:
            return read_as<std::uint32_t>(array.values, part, elevations);
        case ValueType::int64:
            return read_as<std::int64_t>(array.values, part, elevations);
        case ValueType::uint64:
            return read_as<std::uint64_t>(array.values, part, elevations);
        case ValueType::float32:
            return read_as<float>(array.values, part, elevations);
        case ValueType::float64:
            return read_as<double>(array.values, part, elevations);
    }
}

void require_array_options(const ReadOptions& options, const std::string& name) {
    const std::string given = options.band != 1               ? "-b"
                              : !options.open_options.empty() ? "-oo"
                              : !options.drivers.empty()      ? "-if"
                                                              : "";
    if (!given.empty())
        throw OptionError(given + " says how a file is read and means nothing for '" + name +
                          "'; leave it out.");
}

DemInfo describe(const ElevationArray& array, const ReadOptions& options, Warnings& warnings) {
    DemInfo info;
    info.name = array.name;
    info.rows = array.rows;
    info.cols = array.cols;
    info.driver = "array";
    info.bytes = array.type == ValueType::uint8;
    set_transform(array.transform, "correct it", info, warnings);
    set_crs("", options.crs, info, warnings);
    info.window = choose_window(options, info);
    if (const std::string doubt = doubt_of_extent(options, info); !doubt.empty())
        warnings.add(doubt);
    return info;
}

class ArrayDemSource final : public DemSource {
  public:
    ArrayDemSource(const ElevationArray& array, const ReadOptions& options, Warnings& warnings)
        : array_(array),
          info_(describe(array, options, warnings)),
          cutline_(open_cutline(options, info_, warnings)) {
        if (options.nodata)
            nodata_ = array.type == ValueType::float32 ? as_single(*options.nodata) : *options.nodata;
    }

    [[nodiscard]] const DemInfo& info() const override { return info_; }

    void read(const Window& part, std::span<double> elevations) override {
        require_part(info_, part, elevations.size());
        read_values(array_, part, elevations.data());
        for (double& value : elevations)
            if (!std::isfinite(value) || value == nodata_)
                value = std::numeric_limits<double>::quiet_NaN();
        take_out_masked(part, elevations.data());
        if (cutline_)
            cutline_->apply(part, elevations);
    }

  private:
    void take_out_masked(const Window& part, double* elevations) const {
        if (array_.masked.first == nullptr)
            return;
        for (std::int32_t row = part.row; row < part.row + part.rows; ++row)
            for (std::int32_t col = part.col; col < part.col + part.cols; ++col, ++elevations)
                if (*at(array_.masked, row, col) != std::byte{0})
                    *elevations = std::numeric_limits<double>::quiet_NaN();
    }

    ElevationArray array_;
    DemInfo info_;
    std::unique_ptr<CutlineMask> cutline_;
    std::optional<double> nodata_;
};

}  // namespace

std::unique_ptr<DemSource> open_dem(const ElevationArray& array, const ReadOptions& options,
                                    const Callbacks& callbacks) {
    if (array.rows < 1 || array.cols < 1)
        throw InputError("'" + array.name + "' has no cells; give at least one row and one column.");
    register_formats();
    require_array_options(options, array.name);
    Warnings warnings(callbacks.on_warning);
    return std::make_unique<ArrayDemSource>(array, options, warnings);
}

}  // namespace d2b
