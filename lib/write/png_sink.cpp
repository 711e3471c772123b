#include "write/png_sink.hpp"

#include <optional>
#include <utility>

#include <cpl_vsi.h>

#include "core/error.hpp"
#include "write/config_option.hpp"
#include "write/existing_dataset.hpp"
#include "write/ogr_call.hpp"
#include "write/staging.hpp"

namespace d2b {

namespace {

/// The picture as a dataset in memory, from which the driver makes the file: PNG is written in one go.
DatasetHandle in_memory(const Image& image, const WriteTarget& target) {
    OgrCall call(target);
    constexpr int bands = 3;
    DatasetHandle dataset(
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
    PngFile(RasterPlace place, Context& context)
        : place_(std::move(place)), target_{.name = place_.name, .hidden_folder = "", .context = &context} {}
    ~PngFile() override {
        const GdalMessages quiet;
        if (!beside_.empty())
            VSIUnlink(beside_.c_str());
    }

    void write(const Image& image) override;
    void publish() override;

  private:
    RasterPlace place_;
    WriteTarget target_;
    std::optional<Staging> staging_;
    std::string beside_;  ///< what is written meanwhile in a virtual file system
};

void PngFile::write(const Image& image) {
    const ConfigOption no_sidecar("GDAL_PAM_ENABLED", "NO");
    std::string path;
    if (place_.local) {
        staging_.emplace(place_.name, place_.path);
        target_.hidden_folder = staging_->folder().string() + "/";
        path = staging_->dataset().string();
    } else {
        path = beside_ = place_.path + ".part";
    }
    const DatasetHandle picture = in_memory(image, target_);
    OgrCall call(target_);
    DatasetHandle file(GDALCreateCopy(GDALGetDriverByName("PNG"), path.c_str(), picture.get(), FALSE, nullptr,
                                      nullptr, nullptr));
    call.check(file != nullptr, "writing the picture");
    close_written(target_, std::move(file));
}

void PngFile::publish() {
    if (!staging_) {
        OgrCall call(target_);
        if (!place_.old_files.empty())
            VSIUnlink(place_.path.c_str());
        call.check(VSIRename(beside_.c_str(), place_.path.c_str()) == 0, "renaming the finished picture");
        beside_.clear();
        return;
    }
    staging_->seal();
    staging_->sync();
    if (stamp_of(place_.old_files) != place_.stamp)
        throw OutputError("\"" + place_.name +
                          "\" has changed while this run was going on and is left alone; run again.");
    staging_->publish(place_.old_files);
    staging_.reset();
}

}  // namespace

std::unique_ptr<PictureFile> open_picture(const RasterTarget& target, Context& context) {
    if (GDALGetDriverByName("PNG") == nullptr)
        throw OptionError("This GDAL cannot write PNG; leave the picture out.");
    return std::make_unique<PngFile>(locate_raster(target), context);
}

}  // namespace d2b
