#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "dem2buildings/sinks.hpp"
#include "dem2buildings/spool.hpp"
#include "write/file_target.hpp"

namespace d2b::writing {

/// File of a surface, written in pieces under a temporary name and published by a CommitList, like a GeoTIFF
/// of open_geotiff_sink(). Until then the destination is unchanged. A sink that writes two files has two of
/// these; dem2buildings/commit_list.hpp defines the order in which it prepares them.
class SurfaceFile {
  public:
    explicit SurfaceFile(FileDestination place);
    SurfaceFile(const SurfaceFile&) = delete;
    SurfaceFile& operator=(const SurfaceFile&) = delete;
    ~SurfaceFile();

    /// Appends bytes. @throws OutputError
    void write(std::string_view bytes);
    /// Completes the file and adds it to a commit. @param commit publishes it during the lifetime of this
    /// object @throws OutputError
    void prepare(CommitList& commit);
    /// Call instead of prepare() if there is nothing to publish; adds a warning. @param why for example "an
    /// STL without a solid is none"
    void skip_with_warning(const std::string& why);
    void warn(const std::string& sentence);
    /// Returns the warnings since the last call, one sentence each.
    [[nodiscard]] std::vector<std::string> take_warnings();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Buffers bytes that come late in a file but are known early: in memory while they are few, then in a
/// temporary file.
class SpillBuffer {
  public:
    /// @throws OutputError if there is no space
    void add(std::string_view bytes);
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// Appends all bytes to a file. @throws OutputError
    void write_to(SurfaceFile& file);

  private:
    void spill();

    FileSpool spool_;
    std::string buffer_;
    std::vector<SpoolEntry> entries_;
    std::uint64_t size_ = 0;
};

/// Returns an object with the values of a feature by field name, in the order of the fields.
[[nodiscard]] nlohmann::ordered_json field_json(std::span<const FieldSpec> fields,
                                                std::span<const FieldValue> values);

/// Returns one line. Invalid UTF-8 becomes U+FFFD, because JSON cannot hold it.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json);

/// JSON list with one item per building, spilled to disk if large: text with commas, without brackets.
class JsonListBuffer {
  public:
    /// @return index of the item
    std::uint64_t add(const nlohmann::ordered_json& item) {
        text_.add((count_ == 0 ? "" : ",") + json_text(item));
        return count_++;
    }
    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] SpillBuffer& text() { return text_; }

  private:
    SpillBuffer text_;
    std::uint64_t count_ = 0;
};

}  // namespace d2b::writing
