// Fields of rows of cells, which neighbouring rows of beams share: made once, kept until no later row of
// beams hears them. Draws no numbers.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace echoloop {

class RowFields {
  public:
    void clear() { keep_from(~std::uint32_t{0}); }
    /// Gives the memory of the rows before `row` to those that come.
    void keep_from(std::uint32_t row);
    /// The field of a cell of a row; empty when it is new.
    std::vector<float>& of(std::uint32_t row, std::uint32_t cell);

  private:
    using Field = std::vector<float>;
    struct Row {
        std::uint32_t number = 0;
        std::unordered_map<std::uint32_t, Field> of_cells;
    };
    std::vector<Row> rows_;
    std::vector<Field> spare_;
};

}  // namespace echoloop
