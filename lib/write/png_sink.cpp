#include "write/png_sink.hpp"

#include <utility>

#include "dem2buildings/error.hpp"
#include "write/config_option.hpp"
#include "write/existing_dataset.hpp"
#include "write/ogr_call.hpp"
#include "write/staged_raster.hpp"

namespace d2b {

namespace {

/// The picture as a dataset in memory, from which the driver makes the file: PNG is written in one go.
DatasetOwner in_memory(const Image& image, const WriteTarget& target) {
    OgrCall call(target);
    constexpr int bands = 3;
    DatasetOwner dataset(
        GDALCreate(GDALGetDriverByName("MEM"), "", image.width, image.height, bands, GDT_Byte, nullptr));
    call.check(dataset != nullptr, "making the picture");
    // GDAL takes what it writes as changeable, which it does not change.
    auto* pixels = const_cast<std::uint8_t*>(image.rgb.data());
    const CPLErr done =
        GDALDatasetRasterIO(dataset.get(), GF_Write, 0, 0, image.width, image.height, pixels, image.width,
                            image.height, GDT_Byte, bands, nullptr, bands, bands * image.width, 1);
    call.check(done == CE_None, "making the picture");
    return dataset;
}

class PngFile final : public PictureFile {
  public:
    explicit PngFile(RasterPlace place) : staged_(std::move(place)) {}

    void write(const Image& image) override;
    void publish() override { staged_.publish("renaming the finished picture"); }
    [[nodiscard]] std::vector<std::string> take_warnings() override { return staged_.take_warnings(); }

  private:
    StagedRaster staged_;
};

void PngFile::write(const Image& image) {
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    const std::string path = staged_.begin();
    const DatasetOwner picture = in_memory(image, staged_.target());
    OgrCall call(staged_.target());
    DatasetOwner file(GDALCreateCopy(GDALGetDriverByName("PNG"), path.c_str(), picture.get(), FALSE, nullptr,
                                     nullptr, nullptr));
    call.check(file != nullptr, "writing the picture");
    close_written(staged_.target(), std::move(file));
}

}  // namespace

std::unique_ptr<PictureFile> open_picture(const RasterTarget& target) {
    if (GDALGetDriverByName("PNG") == nullptr)
        throw OptionError("This GDAL cannot write PNG; leave the picture out.");
    return std::make_unique<PngFile>(locate_raster(target));
}

}  // namespace d2b
