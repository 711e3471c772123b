#pragma once

#include <algorithm>
#include <vector>

#include "core/band.hpp"

namespace d2b {

/// Sets of labels that turned out to be one; the smallest label stands for each. Label 0 is none.
class LabelSets {
  public:
    LabelSets() : parent_{0} {}
    [[nodiscard]] Label add() {
        parent_.push_back(static_cast<Label>(parent_.size()));
        return parent_.back();
    }
    [[nodiscard]] Label find(Label label) {
        while (parent_[label] != label)
            label = parent_[label] = parent_[parent_[label]];
        return label;
    }
    /// @returns the label that stands for both
    Label join(Label a, Label b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
        return std::min(a, b);
    }
    /// A table from labels to numbers from 1 on, one a set, in the order of the labels that stand for them.
    [[nodiscard]] std::vector<Label> numbered() {
        std::vector<Label> number(parent_.size(), 0);
        Label next = 0;
        for (Label i = 1; i < parent_.size(); ++i)
            number[i] = parent_[i] == i ? ++next : number[find(i)];
        return number;
    }

  private:
    std::vector<Label> parent_;
};

}  // namespace d2b
