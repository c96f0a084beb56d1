// A description as text with comments, as first designs and imported lenses are written. Floor 2.
#pragma once
#include "files/description/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace lfdsim {

/// A description being written, in `all`: tables and their keys in the order of the calls, each after its comments.
class CommentedText {
  public:
    /// Adds a comment, wrapped at spaces into lines of at most a hundred columns.
    template <class... Values>
    void note(fmt::format_string<Values...> words, Values&&... values) {
        std::string text = fmt::format(words, std::forward<Values>(values)...);
        for (char& c : text)  // a file's name may contain a line break
            if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
        std::string line = "#";
        for (std::size_t start = 0; start < text.size();) {
            const std::size_t end = std::min(text.find(' ', start), text.size());
            if (line.size() > 1 && line.size() + 1 + end - start > 100) {
                all += line + "\n";
                line = "#";
            }
            line += " " + text.substr(start, end - start);
            start = end + 1;
        }
        all += line + "\n";
    }
    template <class Value>
    void key(const char* name, const Value& value) {
        all += fmt::format("{} = {}\n", name, toml_text(value));
    }
    void table(std::string_view name) { all += fmt::format("\n[{}]\n", name); }
    void list(std::string_view name) { all += fmt::format("\n[[{}]]\n", name); }  // begins an element of the list

    std::string all;
};

/// Returns the beginning that all first designs have: comments, schema and name. In write_first_order.cpp.
CommentedText begun_design(const std::string& name, const std::string& made_by);
struct Panel;
/// Writes the table [panel] up to the pixel pitch of a panel with a diagonal of `inch` inches. In write_first_order.cpp.
void write_panel_pixels(const Panel&, double inch, CommentedText&);

}  // namespace lfdsim
