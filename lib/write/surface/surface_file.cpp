#include "write/surface/surface_file.hpp"

#include <cerrno>
#include <cstddef>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>

#include <cpl_vsi.h>
#include <nlohmann/json.hpp>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "write/ogr_util.hpp"
#include "write/staged_file.hpp"

namespace d2b::writing {
namespace {

constexpr std::size_t bytes_per_write = std::size_t{1} << 20;

constexpr std::size_t bytes_per_entry = std::size_t{1} << 20;

}  // namespace

struct SurfaceFile::Impl {
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
        check(VSIFWriteL(buffer.data(), 1, buffer.size(), file.get()) == buffer.size(), call);
        buffer.clear();
    }
    void close() {
        OgrCall call(staged.target());
        errno = 0;
        check(VSIFCloseL(file.release()) == 0, call);
    }
};

SurfaceFile::SurfaceFile(FileDestination place) : impl_(std::make_unique<Impl>(std::move(place))) {}

SurfaceFile::~SurfaceFile() {
    const reading::GdalMessages quiet;
    impl_->file.reset();
}

void SurfaceFile::write(std::string_view bytes) {
    impl_->buffer += bytes;
    if (impl_->buffer.size() >= bytes_per_write)
        impl_->flush();
}

void SurfaceFile::prepare(CommitList& commit) {
    impl_->flush();
    impl_->close();
    impl_->staged.prepare(commit);
}

void SurfaceFile::skip_with_warning(const std::string& why) {
    warn("There is no building for \"" + impl_->staged.name() + "\", and " + why + "; no file is written" +
         (impl_->staged.replaces() ? ", and the old one stays as it was." : "."));
}

void SurfaceFile::warn(const std::string& sentence) {
    impl_->staged.target().warnings->add(sentence);
}

std::vector<std::string> SurfaceFile::take_warnings() {
    return impl_->staged.take_warnings();
}

void SpillBuffer::add(std::string_view bytes) {
    buffer_ += bytes;
    size_ += bytes.size();
    if (buffer_.size() >= bytes_per_entry)
        spill();
}

void SpillBuffer::spill() {
    const std::uint64_t begin = spool_.append(std::as_bytes(std::span(buffer_)));
    entries_.push_back({begin, buffer_.size()});
    buffer_.clear();
}

void SpillBuffer::write_to(SurfaceFile& file) {
    std::string bytes;
    for (const SpoolEntry& entry : entries_) {
        bytes.resize(entry.size);
        spool_.read(entry.begin, std::as_writable_bytes(std::span(bytes)));
        file.write(bytes);
    }
    file.write(buffer_);
}

nlohmann::ordered_json field_json(std::span<const FieldSpec> fields, std::span<const FieldValue> values) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < fields.size() && i < values.size(); ++i)
        std::visit(
            [&](const auto& value) {
                if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>)
                    object[fields[i].name] = nullptr;
                else
                    object[fields[i].name] = value;
            },
            values[i]);
    return object;
}

std::string json_text(const nlohmann::ordered_json& json) {
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace d2b::writing
