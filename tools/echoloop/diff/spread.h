// How the values of one field are spread over all messages of a capture, and how far two of these lie apart.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace echoloop::diff {

struct Message;

struct Spread {
    std::size_t count = 0;     ///< of values; those that are no finite number do not count
    std::size_t distinct = 0;  ///< of very many values, among those that were looked at
    double least = 0, most = 0, median = 0, p05 = 0, p95 = 0, mean = 0, deviation = 0;
    std::string text{};  ///< of a field of text: one of its values
    bool is_text = false;
};

/// Sorts `values`.
Spread spread_of(std::vector<double>& values);

struct Spreads {
    Spread a, b;
    /// Jensen-Shannon distance of the two histograms, 0 (the same) to 1 (nothing in common), in bins that
    /// hold equally many values of both together; below 0 if there are too few values to tell.
    double distance = -1;
};

/// Of a field, elements of arrays one by one.
Spreads spreads_of(const std::string& field, const std::vector<Message>& a, const std::vector<Message>& b);

/// "constant 25", "79 values, 12.1 to 13.4, median 12.8"
std::string text_of(const Spread& spread);

/// At most nine digits and an exponent, or a whole number of at most fifteen.
std::string number_text(double value);

}  // namespace echoloop::diff
