#include "read/value_dataset.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <gdal_priv.h>

namespace d2b {

namespace {

constexpr int block_size = 256;

class ValueBand final : public GDALRasterBand {
  public:
    explicit ValueBand(ValueSource& source) : source_(source) {
        eDataType = GDT_Float64;
        nRasterXSize = source.cols;
        nRasterYSize = source.rows;
        nBlockXSize = std::min(block_size, source.cols);
        nBlockYSize = std::min(block_size, source.rows);
    }

    double GetNoDataValue(int* known = nullptr) override {
        if (known != nullptr)
            *known = TRUE;
        return std::numeric_limits<double>::quiet_NaN();
    }

  protected:
    CPLErr IReadBlock(int block_col, int block_row, void* data) override {
        try {
            read_block(block_col, block_row, static_cast<double*>(data));
            return CE_None;
        } catch (...) {
            source_.failure = std::current_exception();
            CPLError(CE_Failure, CPLE_AppDefined, "Reading has failed");
            return CE_Failure;
        }
    }

  private:
    /// Clips blocks at the right and lower edge, because they extend beyond the raster.
    void read_block(int block_col, int block_row, double* data) {
        Window part{block_row * nBlockYSize, block_col * nBlockXSize, nBlockYSize, nBlockXSize};
        part.rows = std::min(part.rows, source_.rows - part.row);
        part.cols = std::min(part.cols, source_.cols - part.col);
        values_.resize(static_cast<std::size_t>(part.rows) * static_cast<std::size_t>(part.cols));
        source_.reader.read_part(part, values_, source_.warnings);
        for (std::int32_t i = 0; i < part.rows; ++i)
            std::copy_n(values_.data() + static_cast<std::ptrdiff_t>(i) * part.cols, part.cols,
                        data + static_cast<std::ptrdiff_t>(i) * nBlockXSize);
    }

    ValueSource& source_;
    std::vector<double> values_;
};

class ValueDataset final : public GDALDataset {
  public:
    explicit ValueDataset(ValueSource& source) {
        nRasterXSize = source.cols;
        nRasterYSize = source.rows;
        SetBand(1, std::make_unique<ValueBand>(source).release());
    }
};

}  // namespace

DatasetOwner value_dataset(ValueSource& source) {
    return DatasetOwner(GDALDataset::ToHandle(std::make_unique<ValueDataset>(source).release()));
}

}  // namespace d2b
