#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "dem2buildings/sinks.hpp"
#include "dem2buildings/spool.hpp"
#include "write/file_writer.hpp"

namespace d2b::writing {

/// Buffers bytes that come late in a file but are known early: in memory while they are few, then in a
/// temporary file.
class SpillBuffer {
  public:
    /// @throws OutputError if there is no space
    void add(std::string_view bytes);
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// Appends all bytes to a file. @throws OutputError
    void write_to(FileWriter& file);

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

/// Warns instead of writing a file without anything to show. @param why for example "an STL without a solid
/// is none"
void warn_of_no_building(FileWriter& file, const std::string& why);

}  // namespace d2b::writing
