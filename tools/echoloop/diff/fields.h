// Compares the fields of messages that belong together, and keeps what was found of each field. Reads no
// capture.
#pragma once

#include "tools/echoloop/diff/report.h"
#include "tools/echoloop/diff/rules.h"

namespace echoloop::diff {

class FieldComparison {
  public:
    FieldComparison(std::string type, const Rules& rules) : type_(std::move(type)), rules_(rules) {}

    void add(const Message& a, const Message& b);
    /// In the order of the message.
    std::vector<FieldReport> reports() const;

  private:
    struct Sums {
        FieldReport report;
        Rule rule;
        double squares_a = 0, squares_b = 0;
        std::size_t numbers_a = 0, numbers_b = 0;
        bool same_length = true;
    };
    Sums& sums_of(const NamedValue& field);
    void compare(Sums& sums, const NamedValue& a, const NamedValue& b, const Message& in_a,
                 const Message& in_b);
    void absent(const NamedValue& field, const Message& a, const Message& b, bool in_a);

    std::string type_;
    const Rules& rules_;
    std::vector<Sums> fields_;
    std::map<std::string, std::size_t> by_name_;
};

}  // namespace echoloop::diff
