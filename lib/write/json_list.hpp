#pragma once

#include <cstdint>

#include <nlohmann/json_fwd.hpp>

#include "write/field_json.hpp"
#include "write/held_bytes.hpp"

namespace d2b {

/// JSON list with one item per building, spilled to disk if large: text with commas, without brackets.
class JsonList {
  public:
    /// @return index of the item
    std::uint64_t add(const nlohmann::ordered_json& item) {
        text_.add((count_ == 0 ? "" : ",") + json_text(item));
        return count_++;
    }
    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] HeldBytes& text() { return text_; }

  private:
    HeldBytes text_;
    std::uint64_t count_ = 0;
};

}  // namespace d2b
