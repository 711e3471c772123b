#include "write/surface/surface_text.hpp"

#include <cstddef>
#include <type_traits>
#include <variant>

#include <nlohmann/json.hpp>

namespace d2b::writing {

void SpillBuffer::add(std::string_view bytes) {
    constexpr std::size_t bytes_per_entry = std::size_t{1} << 20;
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

void SpillBuffer::write_to(FileWriter& file) {
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

void warn_of_no_building(FileWriter& file, const std::string& why) {
    file.warn("There is no building for \"" + file.name() + "\", and " + why + "; no file is written" +
              (file.replaces() ? ", and the old one stays as it was." : "."));
}

}  // namespace d2b::writing
