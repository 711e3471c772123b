#pragma once

#include <vector>

#include "core/band.hpp"
#include "core/disjoint_sets.hpp"

namespace d2b {

/// Sets of labels that turned out to be one; the smallest label stands for each. Label 0 is none.
class LabelSets {
  public:
    LabelSets() : sets_(1) {}
    Label add() { return sets_.add(); }
    [[nodiscard]] Label find(Label label) { return sets_.find(label); }
    /// @returns the label that stands for both
    Label join(Label a, Label b) { return sets_.join(a, b); }
    /// A table from labels to numbers from 1 on, one a set, in the order of the labels that stand for them.
    [[nodiscard]] std::vector<Label> numbered() {
        std::vector<Label> number(sets_.size(), 0);
        Label next = 0;
        for (Label i = 1; i < sets_.size(); ++i) {
            const Label first = sets_.find(i);
            number[i] = first == i ? ++next : number[first];
        }
        return number;
    }

  private:
    DisjointSets sets_;
};

}  // namespace d2b
