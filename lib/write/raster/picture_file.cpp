#include "write/raster/picture_file.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "write/ogr_util.hpp"
#include "write/staged_file.hpp"

namespace d2b::writing {

namespace {

class StagedPictureFile final : public PictureFile {
  public:
    explicit StagedPictureFile(FileDestination place)
        : format_(picture_format_of(place.name).value_or(PictureFormat::png)), staged_(std::move(place)) {}

    [[nodiscard]] PictureFormat format() const override { return format_; }
    void write(const std::string& bytes) override;
    void prepare(CommitList& commit) override { staged_.prepare(commit); }
    [[nodiscard]] std::vector<std::string> take_warnings() override { return staged_.take_warnings(); }

  private:
    PictureFormat format_;
    StagedFile staged_;
};

void StagedPictureFile::write(const std::string& bytes) {
    const std::string path = staged_.begin();
    const std::string doing = "writing the picture";
    OgrCall call(staged_.target());
    VSILFILE* file = VSIFOpenL(path.c_str(), "wb");
    call.check(file != nullptr, doing);
    errno = 0;
    const bool written = VSIFWriteL(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const bool closed = VSIFCloseL(file) == 0;
    const int reason = errno;
    // GDAL does not report the reason for local files.
    if (!(written && closed) && call.succeeded() && reason != 0)
        throw OutputError("Cannot write \"" + staged_.name() +
                          "\": " + std::generic_category().message(reason) + ".");
    call.check(written && closed, doing);
}

}  // namespace

std::unique_ptr<PictureFile> open_picture(const FileTarget& target) {
    return std::make_unique<StagedPictureFile>(resolve_file_target(target));
}

}  // namespace d2b::writing
