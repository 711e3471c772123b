#include "write/surface_file.hpp"

#include <cerrno>
#include <cstddef>
#include <system_error>
#include <utility>

#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "write/ogr_call.hpp"
#include "write/staged_raster.hpp"

namespace d2b {
namespace {

constexpr std::size_t bytes_a_write = std::size_t{1} << 20;

}  // namespace

struct SurfaceFile::Impl {
    struct Close {
        void operator()(VSILFILE* of) const { VSIFCloseL(of); }
    };
    StagedRaster staged;
    std::unique_ptr<VSILFILE, Close> file{};
    std::string waiting{};

    explicit Impl(RasterPlace place) : staged(std::move(place)) {}

    /// Throws with errno, because GDAL does not report the reason for local files.
    void check(bool done, OgrCall& call) const {
        const int reason = errno;
        if (!done && call.succeeded() && reason != 0)
            throw OutputError("Cannot write \"" + staged.name() +
                              "\": " + std::generic_category().message(reason) + ".");
        call.check(done, "writing the surface");
    }
    void begin() {
        const std::string path = staged.begin();
        OgrCall call(staged.target());
        errno = 0;
        file.reset(VSIFOpenL(path.c_str(), "wb"));
        check(file != nullptr, call);
    }
    void flush() {
        if (!file)
            begin();
        OgrCall call(staged.target());
        errno = 0;
        check(VSIFWriteL(waiting.data(), 1, waiting.size(), file.get()) == waiting.size(), call);
        waiting.clear();
    }
    void close() {
        OgrCall call(staged.target());
        errno = 0;
        check(VSIFCloseL(file.release()) == 0, call);
    }
};

SurfaceFile::SurfaceFile(RasterPlace place) : impl_(std::make_unique<Impl>(std::move(place))) {}

SurfaceFile::~SurfaceFile() {
    const GdalMessages quiet;
    impl_->file.reset();
}

void SurfaceFile::write(std::string_view bytes) {
    impl_->waiting += bytes;
    if (impl_->waiting.size() >= bytes_a_write)
        impl_->flush();
}

void SurfaceFile::prepare(CommitList& commit) {
    impl_->flush();
    impl_->close();
    impl_->staged.prepare(commit);
}

void SurfaceFile::leave_out(const std::string& why) {
    warn("There is no building for \"" + impl_->staged.name() + "\", and " + why + "; no file is written" +
         (impl_->staged.replaces() ? ", and the old one stays as it was." : "."));
}

void SurfaceFile::warn(const std::string& sentence) {
    impl_->staged.target().warnings->add(sentence);
}

std::vector<std::string> SurfaceFile::take_warnings() {
    return impl_->staged.take_warnings();
}

}  // namespace d2b
