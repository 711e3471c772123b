#include "write/file_writer.hpp"

#include <cerrno>
#include <cstddef>
#include <system_error>
#include <utility>

#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "write/ogr_util.hpp"
#include "write/staged_file.hpp"

namespace d2b::writing {

struct FileWriter::Impl {
    StagedFile staged;
    reading::GdalOwner<VSILFILE*, VSIFCloseL> file{};
    std::string buffer{};

    explicit Impl(FileDestination place) : staged(std::move(place)) {}

    /// Throws with errno, because GDAL does not report the reason for local files.
    void check(bool done, OgrCall& call) const {
        const int reason = errno;
        if (!done && call.succeeded() && reason != 0)
            throw OutputError("Cannot write \"" + staged.name() +
                              "\": " + std::generic_category().message(reason) + ".");
        call.check(done, "writing the file");
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
        check(VSIFWriteL(buffer.data(), 1, buffer.size(), file.get()) == buffer.size(), call);
        buffer.clear();
    }
    void close() {
        OgrCall call(staged.target());
        errno = 0;
        check(VSIFCloseL(file.release()) == 0, call);
    }
};

FileWriter::FileWriter(FileDestination place) : impl_(std::make_unique<Impl>(std::move(place))) {}

FileWriter::~FileWriter() {
    const reading::GdalMessages quiet;
    impl_->file.reset();
}

const std::string& FileWriter::name() const {
    return impl_->staged.name();
}

bool FileWriter::replaces() const {
    return impl_->staged.replaces();
}

void FileWriter::write(std::string_view bytes) {
    constexpr std::size_t bytes_per_write = std::size_t{1} << 20;
    impl_->buffer += bytes;
    if (impl_->buffer.size() >= bytes_per_write)
        impl_->flush();
}

void FileWriter::prepare(CommitList& commit) {
    impl_->flush();
    impl_->close();
    impl_->staged.prepare(commit);
}

void FileWriter::warn(const std::string& sentence) {
    impl_->staged.target().warnings->add(sentence);
}

std::vector<std::string> FileWriter::take_warnings() {
    return impl_->staged.take_warnings();
}

}  // namespace d2b::writing
